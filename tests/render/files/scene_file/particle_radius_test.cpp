// [[particles]] with a radius that no sphere can have: where the error is.
#include <string>

#include "tests/render/files/scene_file/scene_folder.h"

namespace boule {
namespace {

using testing::HasSubstr;

TEST(ParticleRadius, BadRadiusNamesItsLine) {
  const test::SceneFolder files;
  const auto expect_at = [&](const std::string& file, const std::string& text, int line, int column,
                             const std::string& key = "radius", const std::string& keys = "") {
    static_cast<void>(files.write(file, text));
    const auto refused =
        files.load("scene.toml", "schema = 1\n[[particles]]\nfile = \"" + file + "\"\n" + keys);
    ASSERT_FALSE(refused.ok()) << file;
    const Diagnostic& error = refused.error();
    EXPECT_EQ(error.file, files.path(file)) << error.message;
    EXPECT_EQ(error.line, line) << file;
    EXPECT_EQ(error.column, column) << file;
    EXPECT_EQ(error.key, key) << file;
    EXPECT_THAT(error.message, HasSubstr("expected a number above 0, found '-2'")) << file;
  };
  const std::string comment = "Properties=species:S:1:pos:R:3:radius:R:1";
  const std::string good = "1\n" + comment + "\nC 0 0 0 1\n";
  expect_at("a.xyz", good + "2\n" + comment + "\nC 0 0 0 1\nC 1 0 0   -2\n", 7, 11);
  expect_at("a.csv", "x,y,z,size\n0,0,0,1\n\n1,0,0,-2\n", 4, 7, "size", "radius = \"size\"\n");
  const std::string head =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n";
  expect_at("a.dump",
            head + "0 1\n0 1\n0 1\nITEM: ATOMS id x y z diameter\n2 0 0 0 -2\n1 0 0 0 1\n", 10, 9,
            "diameter");
  expect_at("a.lmp",
            "\n\n1 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\n"
            "Atoms # sphere\n\n1 1 -2 1 0 0 0\n",
            11, 5, "diameter");
}

TEST(ParticleRadius, BadRadiusNamesItsParticleWhenSelecting) {
  const test::SceneFolder files;
  static_cast<void>(files.write("a.csv", "x,y,z,radius\n0,0,0,-1\n1,0,0,-2\n"));
  const auto refused = files.load(
      "scene.toml", "schema = 1\n[[particles]]\nfile = \"a.csv\"\nselect = \"x > 0.5\"\n");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().file, files.path("scene.toml"));
  EXPECT_THAT(refused.error().message, HasSubstr("particle 2 of 2 is -2"));
}

}  // namespace
}  // namespace boule
