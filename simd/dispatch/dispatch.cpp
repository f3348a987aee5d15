#include "simd/dispatch/dispatch.h"

#include <cstdlib>
#include <string>

#include "core/base/exact_math.h"
#include "simd/dispatch/cpu.h"

namespace boule {

// The tables that the kernel objects export.
namespace scalar {
extern const KernelTable kernel_table;
}
namespace sse42 {
extern const KernelTable kernel_table;
}
namespace avx2 {
extern const KernelTable kernel_table;
}
namespace avx512 {
extern const KernelTable kernel_table;
}
namespace neon {
extern const KernelTable kernel_table;
}

namespace {

/// The tables of this build, narrowest first.
const std::vector<const KernelTable*>& built_tables() {
  static const std::vector<const KernelTable*> tables = {
      &scalar::kernel_table,
#ifdef BOULE_HAS_SSE42
      &sse42::kernel_table,
#endif
#ifdef BOULE_HAS_AVX2
      &avx2::kernel_table,
#endif
#ifdef BOULE_HAS_AVX512
      &avx512::kernel_table,
#endif
#ifdef BOULE_HAS_NEON
      &neon::kernel_table,
#endif
  };
  return tables;
}

std::string supported_names() {
  std::string names = "auto";
  for (const IsaInfo& info : list_isas()) {
    if (info.supported) names += ", " + std::string(info.name);
  }
  return names;
}

Diagnostic refusal(std::string_view name, std::string_view origin, const std::string& reason) {
  return Diagnostic::of(std::string(origin) + " " + quote(name) + " " + reason +
                        ", expected one of " + supported_names());
}

Result<const KernelTable*> select_named(std::string_view name, std::string_view origin) {
  for (const KernelTable* table : built_tables()) {
    if (isa_name(table->isa) != name) continue;
    if (cpu_supports(table->isa)) return table;
    return refusal(name, origin, "is not supported by this CPU");
  }
  return refusal(name, origin, "is not an instruction set of this build");
}

}  // namespace

std::string_view isa_name(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return "scalar";
    case Isa::sse42:
      return "sse42";
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
    case Isa::neon:
      return "neon";
  }
  return "";
}

std::vector<IsaInfo> list_isas() {
  std::vector<IsaInfo> isas;
  for (const KernelTable* table : built_tables()) {
    isas.push_back({table->isa, isa_name(table->isa), table->width, cpu_supports(table->isa)});
  }
  return isas;
}

Result<const KernelTable*> select_kernels(std::string_view name) {
  if (name != "auto") return select_named(name, "isa");
  const char* forced = std::getenv("BOULE_ISA");
  // Scripts set a variable to the empty string where they have no value for it.
  if (forced != nullptr && *forced != '\0' && std::string_view(forced) != "auto") {
    return select_named(forced, "environment variable BOULE_ISA:");
  }
  const KernelTable* widest = nullptr;
  for (const KernelTable* table : built_tables()) {
    if (cpu_supports(table->isa)) widest = table;
  }
  return widest;
}

}  // namespace boule
