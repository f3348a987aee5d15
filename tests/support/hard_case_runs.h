#pragma once

#include "tests/support/hard_cases.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {

struct IsaAndCase {
  std::string isa;
  HardCaseSpec spec;
};
inline void PrintTo(const IsaAndCase& param, std::ostream* out) {
  *out << param.isa << " " << name_of(param.spec);
}

/// A test of every hard case on the kernels of each ISA; skipped as OnEachIsa is.
class OnEachHardCase : public testing::TestWithParam<IsaAndCase> {
 protected:
  void SetUp() override {
    kernels = kernels_or_null(GetParam().isa);
    if (kernels == nullptr) GTEST_SKIP() << "this CPU has no " << GetParam().isa;
  }

  const KernelTable* kernels = nullptr;
};
/// The parameters of such a test, and their names.
inline auto each_hard_case() {
  std::vector<IsaAndCase> all;
  for (const std::string& isa : all_isa_names()) {
    for (const HardCaseSpec& spec : hard_case_specs()) all.push_back({isa, spec});
  }
  return testing::ValuesIn(all);
}
inline std::string hard_case_name(const testing::TestParamInfo<IsaAndCase>& tested) {
  return tested.param.isa + "_" + name_of(tested.param.spec);
}

}  // namespace boule::test
