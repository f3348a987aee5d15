# boule_library(NAME header source macro otherwise): a library that one source uses. Without it,
# `otherwise` holds.
function(boule_library name header source macro otherwise)
  string(TOUPPER ${name} upper)
  find_path(BOULE_${upper}_INCLUDE_DIR ${header})
  find_library(BOULE_${upper}_LIBRARY ${name})
  mark_as_advanced(BOULE_${upper}_INCLUDE_DIR BOULE_${upper}_LIBRARY)
  if(NOT BOULE_${upper}_INCLUDE_DIR OR NOT BOULE_${upper}_LIBRARY)
    message(STATUS "Without ${header}: ${otherwise}")
    return()
  endif()
  set_property(SOURCE ${source} TARGET_DIRECTORY boule APPEND PROPERTY COMPILE_DEFINITIONS ${macro})
  target_link_libraries(boule PRIVATE ${name})  # by name: an installation can be moved
  set_property(GLOBAL APPEND PROPERTY BOULE_PC_LIBRARIES ${name})
endfunction()
