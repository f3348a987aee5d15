#pragma once

#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "simd/abi/kernel_table.h"

namespace boule {

/// An instruction set for which this build has kernels.
struct IsaInfo {
  Isa isa;
  std::string_view name;  ///< "scalar", "sse42", "avx2", "avx512", "neon"
  int width;              ///< float lanes
  bool supported;         ///< whether the CPU and the operating system can run it
};

/// The instruction sets of this build, narrowest first. Throws std::bad_alloc.
std::vector<IsaInfo> list_isas();

/// The name of an ISA, as in IsaInfo; empty for other values.
std::string_view isa_name(Isa isa);

/// The kernels of the ISA `name`; never null. "auto" stands for the ISA in the environment variable
/// BOULE_ISA. If the variable is unset, empty or "auto" itself, "auto" stands for the widest
/// supported ISA. A name that is unknown, missing from this build or unsupported by the CPU is an
/// error, which lists the valid names. Throws std::bad_alloc.
Result<const KernelTable*> select_kernels(std::string_view name);

/// The reference path as a table: core/reference answers closest_hit and any_hit. Both copy the
/// geometry and may throw std::bad_alloc. The other functions are the kernels of ISA scalar.
const KernelTable& reference_kernels();

}  // namespace boule
