#pragma once

#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "simd/abi/kernel_table.h"

namespace boule {

/// One instruction set this build has kernels for.
struct IsaInfo {
  Isa isa;
  std::string_view name;  ///< "scalar", "sse42", "avx2", "avx512", "neon"
  int width;              ///< float lanes
  bool supported;         ///< the CPU and the operating system can run it
};

/// The instruction sets of this build, narrowest first. Throws std::bad_alloc.
std::vector<IsaInfo> list_isas();

/// Name of an ISA, as in IsaInfo; empty for what is none.
std::string_view isa_name(Isa isa);

/// The kernels of one ISA by name, or for "auto" those that the environment variable BOULE_ISA
/// names, or the widest supported ones, where it is not set, empty or "auto" itself; never null.
/// Any text will do: an unknown name, one this build lacks or one the CPU cannot run is an error
/// that says which names would do. Throws std::bad_alloc.
Result<const KernelTable*> select_kernels(std::string_view name);

/// The scalar reference path behind the same door: every query is answered by core/reference. Each
/// call copies the geometry: its primary_rays, closest_hit and any_hit throw std::bad_alloc.
const KernelTable& reference_kernels();

}  // namespace boule
