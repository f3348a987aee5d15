# The table of ISAs: name, what CMAKE_SYSTEM_PROCESSOR it needs, compiler flags.
# Each row becomes one OBJECT library of the same kernel source, in a namespace of its own.
set(BOULE_ONLY_ISAS "" CACHE STRING
  "The instruction sets to build, scalar always among them; empty: all of this processor")
set(BOULE_ISAS)
macro(boule_isa name processors)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "${processors}" AND
     ("${BOULE_ONLY_ISAS}" STREQUAL "" OR "${name}" IN_LIST BOULE_ONLY_ISAS OR
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
