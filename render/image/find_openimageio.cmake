# OpenImageIO for the one module (and the tests that read pictures back). Debian's package exports
# include directories that are not there (/usr/include/opencv4), which CMake refuses.
find_package(OpenImageIO 2.4 REQUIRED)
foreach(property INTERFACE_INCLUDE_DIRECTORIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES)
  get_target_property(listed OpenImageIO::OpenImageIO ${property})
  set(existing)
  foreach(directory IN LISTS listed)
    if(IS_DIRECTORY "${directory}")
      list(APPEND existing "${directory}")
    endif()
  endforeach()
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES ${property} "${existing}")
endforeach()
