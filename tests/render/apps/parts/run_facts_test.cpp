// What tells the runs of one picture from others.
#include "render/apps/parts/run_facts.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace boule::test {
namespace {

/// Each option that pixels depend on, changed.
const std::function<void(RenderOptions&)> changes[] = {
    [](RenderOptions& o) { o.width = 641; },
    [](RenderOptions& o) { o.height = 361; },
    [](RenderOptions& o) {
      o.crop = PixelRect{0, 0, 10, 10};
    },
    [](RenderOptions& o) { o.spp = 17; },
    [](RenderOptions& o) { o.filter = PixelFilter::tent; },
    [](RenderOptions& o) { o.seed = 1; },
    [](RenderOptions& o) { o.method = Method::path; },
    [](RenderOptions& o) { o.max_depth = 6; },
    [](RenderOptions& o) { o.solver = Solver::fast; },
    [](RenderOptions& o) { o.transparent = true; },
    [](RenderOptions& o) { o.outline = 0.5F; },
    [](RenderOptions& o) { o.fog = 0.5F; },
    [](RenderOptions& o) { o.aovs.id = true; },
};

TEST(RunFacts, ChangedPixelOptionsAreNamed) {
  const RunFacts base = facts_of({}, 1, "0.1.0");
  std::set<std::string> told;
  for (const auto& change : changes) {
    RenderOptions options;
    change(options);
    const std::string text = find_difference(facts_of(options, 1, "0.1.0"), base);
    EXPECT_EQ(text.rfind("has --", 0), 0U) << text;
    told.insert(text);
  }
  EXPECT_EQ(told.size(), std::size(changes));
  EXPECT_TRUE(told.count("has --spp 17, not 1") == 1);
}

TEST(RunFacts, OneOfThemMayDiffer) {
  RenderOptions more, other;
  more.spp = other.spp = 17;
  other.seed = 1;
  const RunFacts base = facts_of({}, 1, "0.1.0");
  EXPECT_EQ(find_difference(facts_of(more, 1, "0.1.0"), base, samples_name), "");
  EXPECT_EQ(find_difference(facts_of(other, 1, "0.1.0"), base, samples_name),
            "has --seed 1, not 0");
}

TEST(RunFacts, LeaveOutOptionsWithoutInfluence) {
  RenderOptions other;
  other.order = PixelOrder::frameless;
  other.tile = 17;
  other.threads = 5;
  other.isa = "scalar";
  EXPECT_EQ(find_difference(facts_of(other, 1, "0.1.0"), facts_of({}, 1, "0.1.0")), "");
}

TEST(RunFacts, ScenesAndVersionsAreToldInWords) {
  const RunFacts base = facts_of({}, 1, "0.1.0");
  EXPECT_EQ(find_difference(facts_of({}, 0xabc, "0.1.0"), base),
            "is of another scene: hash 0000000000000abc, not 0000000000000001");
  EXPECT_EQ(find_difference(facts_of({}, 1, "0.0.9"), base),
            "was written by boule 0.0.9, this is boule 0.1.0");
  EXPECT_EQ(find_difference({}, base), "does not say its --version");
  RunFacts more = base;
  more.emplace_back("x\n", "1");
  EXPECT_EQ(find_difference(more, base), "has --x\\x0a, which is not known");
}

}  // namespace
}  // namespace boule::test
