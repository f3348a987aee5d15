#include "simd/geometry/slot_materials.h"

#include <gtest/gtest.h>

#include <vector>

#include "simd/geometry/geometry.h"

namespace boule::test {
namespace {

/// More than are scanned, each in a material of its own if `many`.
std::vector<Sphere> row_of_spheres(std::size_t count, bool many) {
  std::vector<Sphere> spheres;
  for (std::size_t i = 0; i < count; ++i)
    spheres.push_back({{static_cast<float>(i), 0, 0}, 0.25F, many ? i % 7 : 3});
  return spheres;
}

TEST(SlotMaterials, OneSharedMaterialTakesNoMemory) {
  for (const std::size_t count : {1U, 10U, 1000U}) {
    const Geometry geometry(row_of_spheres(count, false), {});
    EXPECT_EQ(geometry.materials().by_slot(), nullptr);
    EXPECT_EQ(geometry.materials()[0].index(), 3U);
  }
}

TEST(SlotMaterials, EachSlotHasItsSpheresMaterial) {
  for (const std::size_t count : {2U, 10U, 1000U, 100'000U}) {
    const std::vector<Sphere> spheres = row_of_spheres(count, true);
    const Geometry geometry(spheres, {});
    const SphereView view = geometry.view().spheres;
    std::size_t found = 0;
    for (std::uint32_t slot = 0; slot < view.block_count * bvh_leaf_size; ++slot) {
      if (view.id[slot] < 0) continue;
      ++found;
      const Sphere& sphere = spheres[static_cast<std::size_t>(view.id[slot])];
      ASSERT_EQ(geometry.materials()[slot], sphere.material) << slot;
      ASSERT_EQ(geometry.sphere(slot).center, sphere.center) << slot;
      ASSERT_EQ(geometry.sphere(slot).radius, sphere.radius) << slot;
    }
    EXPECT_EQ(found, count);
  }
}

TEST(SlotMaterials, CanViewForeignMemory) {
  const std::vector<MaterialRef> refs{1, 2, 3};
  const SlotMaterials materials(refs.data(), 4);
  EXPECT_EQ(materials.by_slot(), refs.data());
  EXPECT_EQ(materials[2], refs[2]);
}

TEST(SlotMaterials, MissingMaterialsBecomeTheFirst) {
  const std::vector<MaterialRef> refs{1, 2, 3};
  const SlotMaterials materials(refs.data(), 3);
  EXPECT_EQ(materials[1], refs[1]);
  EXPECT_EQ(materials[2], MaterialRef());
}

TEST(SlotMaterials, ZeroSpheresGiveTheFirstMaterial) {
  const Geometry nothing({}, {});
  EXPECT_EQ(nothing.materials().by_slot(), nullptr);
  EXPECT_EQ(nothing.sphere_count(), 0U);
}

}  // namespace
}  // namespace boule::test
