// How particles stand in a picture whose camera does not say it.
#include <string>

#include "tests/render/files/scene_file/scene_folder.h"

namespace boule {
namespace {

class TomlPoseTest : public testing::Test {
 protected:
  /// The fit of a scene that shows a molecule, which is long along y and short along x.
  [[nodiscard]] CameraFit fit_of(const std::string& comment, const std::string& keys = {},
                                 const char* species = "C ") const {
    std::string rows;
    for (const char* place : {"0 -9 0", "0 9 0", "0 0 4", "0 0 -4", "1 0 0", "-1 0 0"})
      rows += species + std::string(place) + "\n";
    static_cast<void>(files_.write("one.xyz", "6\n" + comment + "\n" + rows));
    const auto loaded = files_.load(
        "scene.toml", "schema = 1\n[[particles]]\nfile = \"one.xyz\"\nradius = 1\n" + keys);
    EXPECT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
    return loaded.ok() ? loaded.value().scene.fit : CameraFit{};
  }

  test::SceneFolder files_;
};

void expect_principal(const CameraFit& fit) {
  ASSERT_TRUE(fit.direction && fit.up);
  EXPECT_NEAR(std::fabs(fit.direction->x), 1, 1e-3);
  EXPECT_NEAR(fit.up->z, 1, 1e-3);
  EXPECT_FALSE(fit.pose);
}

TEST_F(TomlPoseTest, MoleculesStandByTheirAxes) {
  expect_principal(fit_of(""));
  EXPECT_EQ(fit_of("", "[camera]\nfit = true\npose = \"upright\"\n"), CameraFit{});
  EXPECT_EQ(fit_of("", "[camera]\nfit = true\nup = [0, 0, 1]\n").direction, std::nullopt);
  EXPECT_EQ(fit_of("", "[[plane]]\n"), CameraFit{});
}

TEST_F(TomlPoseTest, ThingsInACellStandUpright) {
  const std::string lattice = "Lattice=\"9 0 0 0 9 0 0 0 9\"";
  const CameraFit fit = fit_of(lattice);
  EXPECT_EQ(fit.direction, std::nullopt);
  EXPECT_EQ(fit.up, (Vec3f{0, 0, 1}));
  expect_principal(fit_of(lattice, "[camera]\nfit = true\npose = \"principal\"\n"));
}

TEST_F(TomlPoseTest, PointsWithoutSpeciesStandUpright) {
  EXPECT_EQ(fit_of("Properties=pos:R:3", "", ""), CameraFit{});
}

TEST_F(TomlPoseTest, WrongPosesAreRefused) {
  const auto refused = [&](const std::string& keys) {
    const auto loaded = files_.load("scene.toml", "schema = 1\n[camera]\nfit = true\n" + keys);
    return loaded.ok() ? "" : loaded.error().key + ": " + loaded.error().message;
  };
  EXPECT_EQ(refused("pose = \"principal\"\nup = [0, 0, 1]\n"),
            "camera.pose: principal takes neither a direction nor an up");
  EXPECT_THAT(refused("pose = \"principle\"\n"), testing::HasSubstr("did you mean 'principal'?"));
}

}  // namespace
}  // namespace boule
