// What a series chooses once: from all its frames, whichever of them comes first.
#include "render/apps/job/scene_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class SceneLoaderTest : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::string path = (folder_.path() / name).string();
    test::write_bytes(path, text);
    return path;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  /// The command for the frames 0 .. last of a file.
  static RenderJob series(const std::string& file, int last) {
    RenderJob command;
    command.scene = file;
    command.frames = FrameRange{0, last, 1};
    return command;
  }
  static LoadedScene load(SceneLoader& loader, int frame) {
    auto loaded = loader.load(frame);
    EXPECT_TRUE(loaded) << (loaded ? "" : format_diagnostic(loaded.error()));
    return loaded ? std::move(loaded).value() : LoadedScene{};
  }
  /// A frame by a loader that has read no other.
  static LoadedScene load_alone(const RenderJob& command, int frame) {
    SceneLoader loader(command);
    return load(loader, frame);
  }

 private:
  test::TempDir folder_;
};

/// A frame of `count` particles of a species on the x axis, so far apart.
std::string row(const std::string& species, int count, double distance) {
  std::string text = std::to_string(count) + "\n\n";
  for (int i = 0; i < count; ++i) text += species + " " + std::to_string(i * distance) + " 0 0\n";
  return text;
}

/// A frame of a dump with one particle for each of these numbers, and its type.
std::string dump(const std::vector<std::pair<int, double>>& types_and_speeds) {
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" +
                     std::to_string(types_and_speeds.size()) +
                     "\nITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS id type x y z v\n";
  int id = 0;
  for (const auto& [type, speed] : types_and_speeds) {
    ++id;
    text += std::to_string(id) + " " + std::to_string(type) + " " + std::to_string(id) + " 1 1 " +
            std::to_string(speed) + "\n";
  }
  return text;
}

std::vector<float> radii(const LoadedScene& loaded) {
  std::vector<float> list;
  for (const Sphere& sphere : loaded.scene.spheres) list.push_back(sphere.radius);
  return list;
}

Vec3f eye_of(const LoadedScene& loaded) {
  return std::get<PinholeCamera>(loaded.scene.camera.value()).pose.eye;
}

TEST_F(SceneLoaderTest, RadiiAreHalfTheSmallestTypicalDistance) {
  const std::string empty = "0\n\n";
  const auto command = series(
      write("a.xyz", empty + row("A", 5, 2) + row("A", 5, 1.5) + row("A", 1, 1) + row("A", 5, 3)),
      4);
  for (const int first : {0, 2, 4}) {
    SceneLoader loader(command);
    const LoadedScene one = load(loader, first);
    EXPECT_THAT(one.notes, Contains(EndsWith("a.xyz: the radius is half the typical distance to "
                                             "the nearest neighbour, 0.75, the smallest of all 5 "
                                             "frames")));
    EXPECT_THAT(radii(one), Each(0.75F));
    for (const int next : {0, 1, 2, 3, 4}) {
      const LoadedScene other = load(loader, next);
      EXPECT_THAT(radii(other), Each(0.75F));
      EXPECT_EQ(eye_of(other), eye_of(one));
    }
    EXPECT_EQ(eye_of(one), eye_of(load_alone(command, 3)));
  }
}

TEST_F(SceneLoaderTest, CameraFitsTheRadiiOfAll) {
  const std::string frames = row("A", 3, 4) + row("A", 3, 1);
  RenderJob given = series(write("a.xyz", frames), 1);
  const LoadedScene chosen = load_alone(given, 0);
  EXPECT_THAT(chosen.notes, Contains("the camera is fitted to all 2 frames"));
  given.look.radius = "0.5";
  EXPECT_EQ(eye_of(chosen), eye_of(load_alone(given, 0)));
}

TEST_F(SceneLoaderTest, CameraLeavesOutFarSpheres) {
  const auto frame = [](double last) {
    std::string text = "1000\n\n";
    for (int i = 0; i < 999; ++i)
      text += "A " + std::to_string(i % 10) + " " + std::to_string(i / 10 % 10) + " " +
              std::to_string(i / 100) + "\n";
    return text + "A " + std::to_string(last) + " 0 0\n";
  };
  RenderJob one = series(write("a.xyz", frame(9) + frame(90000)), 1);
  one.look.radius = "0.01";
  const LoadedScene first = load_alone(one, 0);
  EXPECT_THAT(first.notes, Contains(HasSubstr("all 2 frames, but not to spheres far from all")));
  EXPECT_EQ(eye_of(first), eye_of(load_alone(one, 1)));
  RenderJob other = series(write("b.xyz", frame(9) + frame(9)), 1);
  other.look.radius = "0.01";
  EXPECT_EQ(eye_of(first), eye_of(load_alone(other, 0)));
}

TEST_F(SceneLoaderTest, FogHasTheDepthsOfAllFrames) {
  const auto command = series(write("a.xyz", row("A", 3, 4) + row("A", 3, 1)), 1);
  const ImageSettings one = load_alone(command, 0).scene.image;
  const ImageSettings other = load_alone(command, 1).scene.image;
  ASSERT_TRUE(one.fog_from && one.fog_to);
  EXPECT_EQ(one.fog_from, other.fog_from);
  EXPECT_EQ(one.fog_to, other.fog_to);
  EXPECT_LT(*one.fog_from, *one.fog_to);
  const std::string text =
      "schema = 1\nimage = { fog_to = 900 }\n[[particles]]\nfile = \"a.xyz\"\n";
  const ImageSettings given = load_alone(series(write("a.toml", text), 1), 1).scene.image;
  EXPECT_EQ(given.fog_to, 900);
  RenderJob single;
  single.scene = path("a.xyz");
  SceneLoader loader(single);
  EXPECT_FALSE(loader.load(std::nullopt).value().scene.image.fog_from);
}

TEST_F(SceneLoaderTest, SeriesFilesShareTheNotesName) {
  static_cast<void>(write("a.0.xyz", row("A", 3, 4)));
  static_cast<void>(write("a.1.xyz", row("A", 3, 1)));
  SceneLoader loader(series(path("a.#.xyz"), 1));
  const LoadedScene first = load(loader, 0), second = load(loader, 1);
  const std::string note = path("a.#.xyz") + ": the radius is half the typical distance";
  EXPECT_THAT(first.notes, Contains(StartsWith(note)));
  EXPECT_THAT(second.notes, ElementsAre(first.notes.front()));
  EXPECT_THAT(radii(first), Each(0.5F));
}

TEST_F(SceneLoaderTest, UnknownSpeciesHaveOneRadius) {
  const auto frame = [](double distance) {
    const std::string at = std::to_string(distance);
    return "3\n\nC 0 0 0\nC " + at + " 0 0\nbead 0 " + at + " 0\n";
  };
  const auto command = series(write("a.xyz", row("C", 3, 1) + frame(4) + frame(2)), 2);
  SceneLoader loader(command);
  EXPECT_THAT(radii(load(loader, 1)), ElementsAre(1.77F, 1.77F, 1));
  EXPECT_THAT(radii(load(loader, 2)), ElementsAre(1.77F, 1.77F, 1));
  const LoadedScene first = load_alone(command, 0);
  EXPECT_THAT(first.notes, Contains(AllOf(HasSubstr("lacks the species 'bead'"),
                                          EndsWith(", 1, the smallest of all 3 frames"))));
}

TEST_F(SceneLoaderTest, MostOfAllAreElementsOrNot) {
  // By itself the first frame has van der Waals radii, and the second half the distance.
  const auto command = series(write("a.xyz", row("C", 2, 2) + row("bead", 5, 2)), 1);
  EXPECT_THAT(radii(load_alone(command, 0)), Each(1));
  EXPECT_THAT(radii(load_alone(command, 1)), Each(1));
  const auto more = series(write("b.xyz", "0\n\n" + row("C", 5, 2) + row("bead", 2, 2)), 2);
  EXPECT_THAT(radii(load_alone(more, 0)), IsEmpty());
  EXPECT_THAT(radii(load_alone(more, 1)), Each(1.77F));
  EXPECT_THAT(radii(load_alone(more, 2)), Each(1));
}

TEST_F(SceneLoaderTest, ColoursHaveTheRangeOfAllFrames) {
  auto command = series(
      write("a.dump", dump({}) + dump({{1, 0.5}}) + dump({{1, 1}, {1, 7.5}}) + dump({{1, -2}})), 3);
  command.look.color = "v";
  for (const int first : {0, 3}) {
    SceneLoader loader(command);
    EXPECT_THAT(load(loader, first).notes,
                Contains(HasSubstr("the colours of 'v' go from -2 to 7.5, the lowest 1st and the "
                                   "highest 99th percentile of all 4 frames")));
    ASSERT_EQ(loader.colors().size(), 1U);
    EXPECT_THAT(loader.colors()[0].scale->range, ElementsAre(-2, 7.5));
    EXPECT_THAT(loader.colors()[0].species, IsEmpty());
  }
  command.look.range = {0, 1};
  SceneLoader given(command);
  EXPECT_THAT(load(given, 0).notes, Not(Contains(HasSubstr("the colours of"))));
  EXPECT_THAT(given.colors()[0].scale->range, ElementsAre(0, 1));
}

TEST_F(SceneLoaderTest, NumbersAreKindsInAllOrNone) {
  auto command = series(
      write("a.dump", dump({}) + dump({{3, 1}}) + dump({{3, 2}, {1, 2}}) + dump({{2, 1}})), 3);
  command.look.color = "type";
  SceneLoader loader(command);
  EXPECT_THAT(load(loader, 0).notes,
              Contains(HasSubstr("the numbers of 'type' are taken as kinds, with a colour each: 3 "
                                 "in all 4 frames")));
  const auto& kinds = loader.colors().at(0).species;
  ASSERT_EQ(kinds.size(), 3U);
  const auto colour = [&](const std::string& name) {
    return std::find_if(kinds.begin(), kinds.end(), [&](auto& one) { return one.name == name; })
        ->color;
  };
  const auto shown = [&](int frame) {
    return load(loader, frame).scene.spheres[0].material.color();
  };
  EXPECT_EQ(shown(1), colour("3"));
  EXPECT_EQ(shown(2), colour("3"));
  EXPECT_EQ(shown(3), colour("2"));
  EXPECT_EQ(hex_text(colour("1")), "#e69f00");  // by their numbers, whichever comes first
  // One number that is not whole makes all of them a quantity.
  auto speeds = series(write("b.dump", dump({{1, 1}, {1, 2}}) + dump({{1, 2.5}})), 1);
  speeds.look.color = "v";
  SceneLoader mapped(speeds);
  static_cast<void>(load(mapped, 0));
  EXPECT_THAT(mapped.colors().at(0).scale->range, ElementsAre(1, 2.5));
  EXPECT_THAT(mapped.colors().at(0).species, IsEmpty());
}

TEST_F(SceneLoaderTest, EmptyFramesMayLackEveryColumn) {
  const std::string frame = "1\nProperties=species:S:1:pos:R:3:q:R:1\nC 0 0 0 0.5\n";
  auto command = series(write("a.xyz", "0\n\n" + frame), 1);
  command.look.color = "q";
  command.look.select = "q > 0";
  command.look.radius = "q";
  SceneLoader loader(command);
  EXPECT_THAT(load(loader, 0).scene.spheres, IsEmpty());
  EXPECT_THAT(radii(load(loader, 1)), ElementsAre(0.5F));
  EXPECT_TRUE(loader.colors().at(0).scale);
}

TEST_F(SceneLoaderTest, FloorLiesBelowAllFrames) {
  auto command = series(write("a.xyz", "2\n\nA 0 5 0\nA 1 5 0\n2\n\nA 0 -3 0\nA 4 1 0\n"), 1);
  command.look.floor = true;
  for (const int frame : {0, 1}) {
    const LoadedScene loaded = load_alone(command, frame);
    ASSERT_EQ(loaded.scene.planes.size(), 1U);
    EXPECT_EQ(loaded.scene.planes[0].point, (Vec3f{0, -3.5F, 0}));
  }
}

TEST_F(SceneLoaderTest, ScenesChooseForEachOfTheirTables) {
  static_cast<void>(write("a.xyz", row("A", 3, 4) + row("A", 3, 2)));
  static_cast<void>(write("b.xyz", row("bead", 3, 1) + row("bead", 3, 6)));
  const std::string scene =
      write("s.toml",
            "schema = 1\n[[particles]]\nfile = \"a.xyz\"\n[[particles]]\n"
            "file = \"b.xyz\"\n[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n");
  for (const int frame : {0, 1}) {
    EXPECT_THAT(radii(load_alone(series(scene, 1), frame)), ElementsAre(1, 1, 1, 0.5F, 0.5F, 0.5F));
  }
}

TEST_F(SceneLoaderTest, AnotherLookChoosesAnew) {
  auto command = series(write("a.dump", dump({{1, 0.5}}) + dump({{2, 4}})), 1);
  SceneLoader loader(command);
  LookOptions look;
  look.color = "v";
  ASSERT_TRUE(loader.load_as(look, 0));
  EXPECT_THAT(loader.colors()[0].scale->range, ElementsAre(0.5, 4));
  look.color = "nothing";
  EXPECT_FALSE(loader.load_as(look, 0));
  EXPECT_THAT(loader.colors()[0].scale->range, ElementsAre(0.5, 4));
  look.color = "type";
  ASSERT_TRUE(loader.load_as(look, 1));
  EXPECT_EQ(loader.colors()[0].species.size(), 2U);
}

TEST_F(SceneLoaderTest, UnreadableFrameEndsTheChoices) {
  static_cast<void>(write("a.0.xyz", row("A", 3, 4)));
  static_cast<void>(write("a.1.xyz", row("A", 3, 2)));
  SceneLoader loader(series(path("a.#.xyz"), 2));
  const LoadedScene first = load(loader, 0);
  EXPECT_THAT(radii(first), Each(1));
  EXPECT_THAT(first.notes, Contains(EndsWith("the smallest of 2 of the 3 frames")));
  EXPECT_THAT(first.notes, Not(Contains(HasSubstr("is fitted"))));
  EXPECT_FALSE(loader.load(2));
}

}  // namespace
}  // namespace boule
