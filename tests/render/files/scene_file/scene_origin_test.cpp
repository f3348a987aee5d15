// Which origin is chosen, and what is told.
#include "render/files/scene_file/loaded/scene_origin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/case_random.h"

namespace boule {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

SphereExtent box(const Vec3d& low, const Vec3d& high, double radius) {
  SphereExtent extent;
  extent.add(low, radius);
  extent.add(high, radius);
  return extent;
}
SphereExtent ball(const Vec3d& center, double radius) { return box(center, center, radius); }

SphereExtent moved(SphereExtent extent, const Vec3d& by) {
  return box(extent.low + by, extent.high + by, extent.radius);
}

std::vector<std::string> notes_of(const SceneExtents& spheres) {
  std::vector<std::string> notes;
  choose_origin(spheres, {}, notes);
  return notes;
}

TEST(SceneOrigin, IsZeroForWhatIsThere) {
  const std::vector<SceneExtents> scenes = {
      {},
      {SphereExtent{}},
      {ball({0, 0, 0}, 1e-6)},
      {ball({100, -50, 20}, 1)},
      {box({0, 0, 0}, {1, 1, 1}, 0.003)},  // a gas: rounding shows, but no point is better
      {box({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}, 5e-4)},  // a sphereflake
      {box({0, 0, 0}, {500, 500, 500}, 1.7)},            // a box of atoms
      {ball({0, -1e6, 0}, 1e6), box({-5, 0, -60}, {5, 1, 0}, 0.4), ball({0.1, 0.1, -3}, 0.13)},
      {box({-1e6, 0, 0}, {1e6, 0, 0}, 1)},
  };
  for (const SceneExtents& scene : scenes) {
    EXPECT_EQ(choose_origin(scene), Vec3d{});
    EXPECT_THAT(notes_of(scene), IsEmpty());
  }
}

TEST(SceneOrigin, IsTheRoundNumberOfTheShift) {
  const std::vector<SceneExtents> scenes = {
      {ball({0, 0, 0}, 1)},
      {box({-2, 0, -1}, {5, 3, 1}, 0.3)},
      {box({0, 0, 0}, {1, 1, 1}, 0.003)},
      {box({-2, -2, -2}, {2, 2, 2}, 0.05)},
      {ball({0, -1000, 0}, 1000), box({-10, 0.2, -10}, {10, 1, 10}, 0.2)},  // on a ground
      {box({-10, -1000, -10}, {10, 1, 10}, 0.2)},                           // the same in one file
  };
  for (const SceneExtents& scene : scenes) {
    for (int power = 4; power <= 9; ++power) {
      const double unit = std::nearbyint(std::pow(10, power));
      for (const Vec3d& by : {Vec3d{unit, 0, 0}, Vec3d{unit, unit * -2, unit * 5}}) {
        SceneExtents far;
        for (const SphereExtent& part : scene) far.push_back(moved(part, by));
        EXPECT_EQ(choose_origin(far), by) << power;
        EXPECT_THAT(notes_of(far), ElementsAre(HasSubstr("points are counted from [")));
      }
    }
  }
}

TEST(SceneOrigin, IsTheShiftOfACentredScene) {
  const Vec3d by{691234.5, 5334567.25, 523};
  for (const double size : {0.5, 2.0, 20.0}) {
    test::CaseRandom random(7);
    SphereExtent extent;
    for (int i = 0; i < 4000; ++i) extent.add(by + random.direction() * size, size / 40);
    EXPECT_EQ(choose_origin({extent}), by) << size;
  }
  // Not around 0: a short point in the middle.
  SceneExtents three;
  for (const double x : {0.0, 2.5, 5.0}) three.push_back(ball(by + Vec3d{x, 0, 0}, 1));
  EXPECT_EQ(choose_origin(three), (by + Vec3d{2.5, 0, 0}));
}

TEST(SceneOrigin, IsNearWhatCannotMoveFar) {
  // The small ones decide, not the middle of all.
  const Vec3d by{4321.5, 98765.25, -12345.75};
  const Vec3d origin = choose_origin(
      {ball(by + Vec3d{0, -1e5, 0}, 1e5), ball(by, 0.5), ball(by + Vec3d{4, 0, 0}, 0.5)});
  EXPECT_LE(std::fabs(origin.y - by.y), 2);
}

TEST(SceneOrigin, IsToldWithWhatRoundingLeaves) {
  // Rounded to a multiple of 1 and of 1/16.
  EXPECT_THAT(notes_of({ball({0, 0, 0}, 0.5), ball({1.2e7 + 0.25, 0, 0}, 4)}),
              ElementsAre("positions are rounded by up to 0.5 radii of the smallest sphere: the "
                          "spheres reach too far for 32-bit floats"));
  // Floats, however far apart, are not rounded.
  EXPECT_THAT(notes_of({ball({0, 0, 0}, 0.5), ball({1.2e7, 0, 0}, 4)}), IsEmpty());
  // An origin that helps, though not enough.
  EXPECT_THAT(notes_of({box({1e9, 0, 0}, {1e9 + 2e6, 0, 0}, 0.5)}),
              ElementsAre(testing::AllOf(HasSubstr("counted from [100"), HasSubstr("even so"),
                                         HasSubstr("radii of the smallest sphere"))));
  std::vector<std::string> notes;
  const Vec3d series{5, 6, 7};
  EXPECT_EQ(choose_origin({ball({1e9, 0, 0}, 1)}, series, notes), series);
  EXPECT_THAT(notes, IsEmpty());
}

TEST(SceneOrigin, LeavesOutWhatIsNoSphere) {
  SphereExtent extent;
  const double nan = std::nan("");
  extent.add({nan, 0, 0}, 1);
  extent.add({0, 0, HUGE_VAL}, 1);
  extent.add({0, 0, 0}, 0);
  extent.add({0, 0, 0}, nan);
  EXPECT_TRUE(extent.is_empty());
  extent.add({1, 2, 3}, 4);
  EXPECT_EQ(extent.low, (Vec3d{1, 2, 3}));
  EXPECT_EQ(extent.radius, 4);
  // However small and far: no search without an end.
  EXPECT_EQ(choose_origin({ball({1e9, 0, 0}, 1e-300)}), (Vec3d{1e9, 0, 0}));
  EXPECT_EQ(choose_origin({box({-1e38, 0, 0}, {1e38, 0, 0}, 1e-320)}), Vec3d{});
  // What no float holds is refused, not moved.
  EXPECT_EQ(choose_origin({ball({1e39, 0, 0}, 1)}), Vec3d{});
}

}  // namespace
}  // namespace boule
