#include "simd/dispatch/dispatch.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "simd/dispatch/cpu.h"

namespace boule::test {
namespace {

using testing::HasSubstr;

/// Sets BOULE_ISA for one test.
class Dispatch : public testing::Test {
 protected:
  static void force(const char* isa) { setenv("BOULE_ISA", isa, 1); }
  void SetUp() override { unsetenv("BOULE_ISA"); }
  void TearDown() override { unsetenv("BOULE_ISA"); }
};

TEST_F(Dispatch, ListsScalarFirstAndWidthsRise) {
  const auto isas = list_isas();
  ASSERT_GE(isas.size(), 2U);
  EXPECT_EQ(isas.front().name, "scalar");
  EXPECT_EQ(isas.front().width, 1);
  for (std::size_t i = 1; i < isas.size(); ++i) EXPECT_GT(isas[i].width, isas[i - 1].width);
  for (const IsaInfo& info : isas) EXPECT_EQ(info.supported, cpu_supports(info.isa));
}

TEST_F(Dispatch, EverySupportedNameSelectsItsOwnKernels) {
  for (const IsaInfo& info : list_isas()) {
    const auto by_name = select_kernels(info.name);
    ASSERT_EQ(by_name.ok(), info.supported) << info.name;
    if (!info.supported) {
      EXPECT_THAT(by_name.error().message, HasSubstr("is not supported by this CPU"));
      continue;
    }
    EXPECT_EQ(by_name.value()->isa, info.isa);
    EXPECT_EQ(by_name.value()->width, info.width);
    force(std::string(info.name).c_str());
    const auto by_environment = select_kernels("auto");
    ASSERT_TRUE(by_environment.ok());
    EXPECT_EQ(by_environment.value(), by_name.value());
  }
}

TEST_F(Dispatch, AutoIsTheWidestSupported) {
  int widest = 0;
  for (const IsaInfo& info : list_isas()) {
    if (info.supported) widest = info.width;
  }
  const auto chosen = select_kernels("auto");
  ASSERT_TRUE(chosen.ok());
  EXPECT_EQ(chosen.value()->width, widest);
  force("auto");
  EXPECT_EQ(select_kernels("auto").value(), chosen.value());
}

TEST_F(Dispatch, TheCallersNameBeatsTheEnvironment) {
  force("sse9");
  ASSERT_TRUE(select_kernels("scalar").ok());
  EXPECT_EQ(select_kernels("scalar").value()->isa, Isa::scalar);
}

TEST_F(Dispatch, UnknownNamesGiveErrorsListingValidNames) {
  for (const char* name : {"sse9", "", "AVX2", "avx2 "}) {
    const auto refused = select_kernels(name);
    ASSERT_FALSE(refused.ok()) << name;
    EXPECT_THAT(refused.error().message, HasSubstr("expected one of auto, scalar"));
  }
  force("sse9");
  const auto refused = select_kernels("auto");
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("BOULE_ISA: 'sse9'"));
}

TEST_F(Dispatch, EmptyEnvironmentVariableIsIgnored) {
  const KernelTable* const chosen = select_kernels("auto").value();
  force("");
  const auto kernels = select_kernels("auto");
  ASSERT_TRUE(kernels.ok()) << kernels.error().message;
  EXPECT_EQ(kernels.value(), chosen);
}

TEST_F(Dispatch, AnIsaOfAnotherArchitectureIsUnknown) {
  std::size_t refused = 0;
  for (const char* name : {"neon", "sse42"}) refused += select_kernels(name).ok() ? 0U : 1U;
  EXPECT_GE(refused, 1U);
}

}  // namespace
}  // namespace boule::test
