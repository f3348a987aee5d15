#include "simd/dispatch/cpu.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace boule {

#if defined(__x86_64__)
namespace {

struct CpuId {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
};

CpuId cpuid(unsigned leaf) {
  CpuId id;
  __get_cpuid_count(leaf, 0, &id.eax, &id.ebx, &id.ecx, &id.edx);
  return id;
}

bool has(unsigned word, unsigned bits) { return (word & bits) == bits; }

/// The register files that the operating system saves (XCR0); 0 if it does not report them.
unsigned saved_registers() {
  if (!has(cpuid(1).ecx, bit_OSXSAVE)) return 0;
  unsigned low = 0, high = 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return low;
}

bool supports_sse42() { return has(cpuid(1).ecx, bit_SSE4_2 | bit_POPCNT); }

bool supports_avx2() {
  constexpr unsigned xmm_ymm = 0x6;
  return has(saved_registers(), xmm_ymm) && has(cpuid(1).ecx, bit_AVX | bit_FMA) &&
         has(cpuid(7).ebx, bit_AVX2 | bit_BMI | bit_BMI2);
}

bool supports_avx512() {
  constexpr unsigned xmm_ymm_zmm = 0xe6;
  constexpr unsigned wanted =
      bit_AVX512F | bit_AVX512BW | bit_AVX512DQ | bit_AVX512VL | bit_AVX512CD;
  return supports_avx2() && has(saved_registers(), xmm_ymm_zmm) && has(cpuid(7).ebx, wanted);
}

}  // namespace

bool cpu_supports(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return true;
    case Isa::sse42:
      return supports_sse42();
    case Isa::avx2:
      return supports_avx2();
    case Isa::avx512:
      return supports_avx512();
    case Isa::neon:
      return false;
  }
  return false;
}

#else

bool cpu_supports(Isa isa) {
#if defined(__aarch64__)
  return isa == Isa::scalar || isa == Isa::neon;  // NEON is part of the architecture
#else
  return isa == Isa::scalar;
#endif
}

#endif

}  // namespace boule
