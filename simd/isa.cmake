# The table of ISAs: name, what CMAKE_SYSTEM_PROCESSOR it needs, compiler flags.
# Each row becomes one OBJECT library of the same kernel source, in a namespace of its own.
set(BOULE_ONLY_ISAS "" CACHE STRING
  "The instruction sets to build, scalar always among them; native: the widest that runs here; empty: all")
set(BOULE_ISAS)

# boule_native(NAME FLAG...): NAME is the widest if this processor says that it has all of these, which
# simd/dispatch/cpu.cpp asks for when Boule runs.
set(only ${BOULE_ONLY_ISAS})
function(boule_native name)
  foreach(flag IN LISTS ARGN)
    if(NOT "${processor} " MATCHES "[ \t]${flag} ")
      return()
    endif()
  endforeach()
  set(only ${name} PARENT_SCOPE)
endfunction()
if(BOULE_ONLY_ISAS STREQUAL "native")
  file(STRINGS /proc/cpuinfo processor REGEX "^flags" LIMIT_COUNT 1)
  set(only neon)
  boule_native(sse42 sse4_2 popcnt)
  boule_native(avx2 avx2 fma bmi1 bmi2)
  boule_native(avx512 avx2 fma bmi1 bmi2 avx512f avx512bw avx512dq avx512vl avx512cd)
endif()

macro(boule_isa name processors)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "${processors}" AND
     ("${only}" STREQUAL "" OR "${name}" IN_LIST only OR
      "${name}" STREQUAL "scalar"))
    list(APPEND BOULE_ISAS ${name})
    set(BOULE_ISA_FLAGS_${name} ${ARGN})
  endif()
endmacro()

boule_isa(scalar ".*" -DBOULE_KERNEL_SCALAR)
boule_isa(sse42  "x86_64|AMD64" -msse4.2 -mpopcnt)
boule_isa(avx2   "x86_64|AMD64" -mavx2 -mfma -mbmi -mbmi2)
boule_isa(avx512 "x86_64|AMD64" -mavx2 -mfma -mbmi -mbmi2 -mavx512f -mavx512bw -mavx512dq -mavx512vl -mavx512cd)
boule_isa(neon   "aarch64|arm64")
