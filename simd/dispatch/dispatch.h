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

/// The name of an ISA, as in IsaInfo; empty where the value is no ISA.
std::string_view isa_name(Isa isa);

/// The kernels of the ISA `name`; never null. "auto" stands for the ISA that the environment
/// variable BOULE_ISA names or, where that is not set, empty or "auto" itself, for the widest one
/// that is supported. A name that is unknown, that this build lacks or that the CPU cannot run is
/// an error, which lists the names that would do. Throws std::bad_alloc.
Result<const KernelTable*> select_kernels(std::string_view name);

/// The reference path as a table: core/reference answers closest_hit and any_hit, which copy the
/// geometry and throw std::bad_alloc. The rest are the kernels of ISA scalar.
const KernelTable& reference_kernels();

}  // namespace boule
