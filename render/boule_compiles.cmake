# boule_compiles(result NAME program [INCLUDES folders] [LIBRARIES names]): whether a program compiles
# and links: what is optional is switched on by that alone, not by files that are there or by what
# others say of them. What did so once is not tried again.
function(boule_compiles result name program)
  cmake_parse_arguments(PARSE_ARGV 3 with "" "" "INCLUDES;LIBRARIES")
  string(SHA1 tried "${program};${with_INCLUDES};${with_LIBRARIES}")
  set(compiles ON)
  if(NOT "${BOULE_COMPILED_${name}}" STREQUAL "${tried}")
    try_compile(compiles SOURCE_FROM_CONTENT ${name}.cpp "${program}"
      CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${with_INCLUDES}"
      LINK_LIBRARIES ${with_LIBRARIES} CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON NO_CACHE)
    if(compiles)
      set(BOULE_COMPILED_${name} "${tried}" CACHE INTERNAL "")
    endif()
  endif()
  set(${result} ${compiles} PARENT_SCOPE)
endfunction()
