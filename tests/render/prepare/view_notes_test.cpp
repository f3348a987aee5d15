// What the user is told of a camera whose picture cannot show what is asked for.
#include "render/prepare/view_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/prepare/prepared_scene.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const CameraPose towards_zero{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}};

/// The notes on a picture of 100 x 100 pixels of a lit scene.
std::vector<std::string> notes_on(const Camera& camera, std::vector<Sphere> spheres) {
  Scene scene;
  add_material(scene, Matte{});
  scene.lights = {PointLight{}};
  scene.camera = camera;
  scene.spheres = std::move(spheres);
  return prepare(std::move(scene), 100, 100).value().notes;
}

TEST(ViewNotes, TellWhereNeighboursHaveOneRay) {
  const std::vector<Sphere> ball{{{0, 0, 0}, 1, 0}};
  CameraPose aslant = towards_zero;
  aslant.eye = {10, 10, 10};
  for (const CameraPose& pose : {towards_zero, aslant}) {
    EXPECT_THAT(notes_on(PinholeCamera{pose, 45}, ball), IsEmpty());
    EXPECT_THAT(notes_on(PinholeCamera{pose, 0.1F}, ball), IsEmpty());
  }
  // A pixel is 1.7e-9 radians wide there, and the next direction is 6e-8 away.
  EXPECT_THAT(notes_on(PinholeCamera{aslant, 1e-5F}, ball),
              ElementsAre(HasSubstr("neighbouring pixels have the same ray")));
  EXPECT_THAT(notes_on(OrthographicCamera{towards_zero, 1e-5F}, ball), IsEmpty());
}

TEST(ViewNotes, TellOfSpheresSmallerThanAPixel) {
  // A pixel is 0.2 wide at the distance 10.
  const PinholeCamera camera{towards_zero, 90};
  const Sphere small{{0, 0, 0}, 0.09F, 0}, large{{1, 0, 0}, 0.11F, 0};
  const auto told = ElementsAre(HasSubstr("most spheres are smaller than a pixel"));
  EXPECT_THAT(notes_on(camera, {small, small, large}), told);
  EXPECT_THAT(notes_on(camera, {small, large}), IsEmpty());
  EXPECT_THAT(notes_on(camera, {large}), IsEmpty());
  // Those beside the picture and behind the eye do not count.
  const Sphere beside{{11, 0, 0}, 0.01F, 0}, behind{{0, 0, 11}, 0.01F, 0};
  EXPECT_THAT(notes_on(camera, {large, beside, beside, behind, behind}), IsEmpty());
  EXPECT_THAT(notes_on(OrthographicCamera{towards_zero, 20}, {small}), told);
  EXPECT_THAT(notes_on(OrthographicCamera{towards_zero, 20}, {large}), IsEmpty());
}

TEST(ViewNotes, SpheresOfGroupsCount) {
  Scene scene;
  scene.spheres.assign(100'000, {{0, 0, 0}, 1, 0});
  scene.groups = {{"pair", {{{0, 0, 0}, 1, 0}, {{1, 0, 0}, 2, 0}}, {}, {}}};
  const auto of_spheres = sample_spheres(scene, std::nullopt);
  EXPECT_GT(of_spheres.size(), 3000U);
  EXPECT_LE(of_spheres.size(), 4096U);
  scene.spheres.resize(1);
  Similarity moved;
  moved.scale = 3;
  const auto all = sample_spheres(scene, std::vector<ShownGroup>{{0, moved, {}}, {0, {}, {}}});
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[2].radius, 6);
  EXPECT_EQ(all[4].radius, 2);
}

}  // namespace
}  // namespace boule::test
