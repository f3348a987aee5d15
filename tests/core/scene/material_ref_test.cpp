#include "core/scene/material_ref.h"

#include <gtest/gtest.h>

#include "core/scene/material.h"
#include "core/scene/primitive.h"

namespace boule {
namespace {

TEST(MaterialRef, WithoutAColorIsAPlainIndex) {
  for (const std::uint32_t index : {0U, 1U, 127U, 128U, 0x7fffffffU}) {
    const MaterialRef ref = index;
    EXPECT_EQ(ref.index(), index);
    EXPECT_FALSE(ref.has_color());
  }
}

TEST(MaterialRef, HoldsAnIndexAndAColor) {
  for (const std::uint32_t index : {0U, 1U, 127U}) {
    for (const SrgbColor color :
         {SrgbColor{0, 0, 0}, SrgbColor{255, 255, 255}, SrgbColor{1, 2, 3}}) {
      const auto ref = MaterialRef::colored(index, color);
      EXPECT_EQ(ref.index(), index);
      ASSERT_TRUE(ref.has_color());
      EXPECT_EQ(ref.color(), color);
      EXPECT_FALSE(ref == MaterialRef(index));
    }
  }
}

TEST(MaterialRef, AColorCostsASphereNoMemory) { EXPECT_EQ(sizeof(Sphere), 5 * sizeof(float)); }

TEST(MaterialRef, AMaterialTakesAnotherColor) {
  const Color blue{0, 0.25F, 1};
  const auto plastic = std::get<Plastic>(recolored(Plastic{{1, 0, 0}, 0.5F, 7, 0.25F}, blue));
  EXPECT_EQ(plastic.color, blue);
  EXPECT_EQ(plastic.specular, 0.5F);
  EXPECT_EQ(plastic.shininess, 7);
  EXPECT_EQ(plastic.reflect, 0.25F);
  EXPECT_EQ(std::get<Matte>(recolored(Matte{}, blue)).color, blue);
  EXPECT_EQ(std::get<Metal>(recolored(Metal{}, blue)).color, blue);
  EXPECT_EQ(std::get<Glass>(recolored(Glass{}, blue)).color, blue);
  EXPECT_EQ(std::get<Phong>(recolored(Phong{}, blue)).color, blue);
  EXPECT_EQ(std::get<Emissive>(recolored(Emissive{{2, 8, 4}}, blue)).radiance, (Color{0, 2, 8}));
}

}  // namespace
}  // namespace boule
