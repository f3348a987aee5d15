#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "core/base/platform.h"

/// The xsimd registers of the instruction set that this is compiled for.
namespace boule::BOULE_KERNEL_ISA {

#if defined(__AVX512F__)
using Arch = xsimd::avx512bw;
#elif defined(__AVX2__)
using Arch = xsimd::fma3<xsimd::avx2>;
#elif defined(__SSE4_2__)
using Arch = xsimd::sse4_2;
#else
using Arch = xsimd::neon64;
#endif

using Floats = xsimd::batch<float, Arch>;
using Doubles = xsimd::batch<double, Arch>;
using Integers = xsimd::batch<std::uint32_t, Arch>;
using FloatMask = xsimd::batch_bool<float, Arch>;
using DoubleMask = xsimd::batch_bool<double, Arch>;

}  // namespace boule::BOULE_KERNEL_ISA
