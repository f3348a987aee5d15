# Refuses options of a parent project, of CXXFLAGS or of a toolchain under which hits would be wrong without a
# word: they let the compiler take NaN, infinity and the order of operations for granted.
# core/base/exact_math.h refuses what does not show here.
set(options "${CMAKE_CXX_FLAGS}")
foreach(config IN LISTS CMAKE_BUILD_TYPE CMAKE_CONFIGURATION_TYPES)
  string(TOUPPER "${config}" config)
  string(APPEND options " ${CMAKE_CXX_FLAGS_${config}}")
endforeach()
get_directory_property(inherited COMPILE_OPTIONS)
string(JOIN " " options " ${options}" ${inherited} " ")
set(inexact "-(Ofast|ffast-math|funsafe-math-optimizations|ffinite-math-only|fassociative-math")
string(APPEND inexact "|freciprocal-math|fno-signed-zeros|fno-honor-nans|fno-honor-infinities")
string(APPEND inexact "|fapprox-func|ffp-model=fast|ffp-contract=fast)")
if(options MATCHES "[ ;:\"](${inexact})[ ;>\"]")
  message(FATAL_ERROR "boule: ${CMAKE_MATCH_1} makes its hits wrong. Take it from CMAKE_CXX_FLAGS, CXXFLAGS and "
    "add_compile_options() where boule is configured, and give it to your own targets alone: "
    "target_compile_options(yours PRIVATE ${CMAKE_MATCH_1}).")
endif()
