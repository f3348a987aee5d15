// What is in the picture's file besides its colours: extra channels, metadata, and nothing that
// differs from run to run.
#include <OpenImageIO/imageio.h>

#include <array>
#include <cmath>
#include <limits>

#include "simd/dispatch/dispatch.h"
#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* all_views = "depth,normal,position,id,albedo";

/// A picture's file with its channels by name, row 0 on top.
class PictureFile {
 public:
  explicit PictureFile(const std::string& path) {
    auto input = OIIO::ImageInput::open(path);
    if (!input) throw std::runtime_error(OIIO::geterror());
    spec = input->spec();
    for (int channel = 0; channel < spec.nchannels; ++channel) {
      const bool integers = spec.channelformat(channel) == OIIO::TypeDesc::UINT32;
      channels_.push_back(integers ? read_channel<std::uint32_t>(*input, channel)
                                   : read_channel<float>(*input, channel));
    }
  }
  /// A sample of the data window, counted from its upper left pixel.
  [[nodiscard]] double at(const char* channel, int x, int y) const {
    const int index = spec.channelindex(channel);
    if (index < 0) throw std::runtime_error(channel);
    return channels_[static_cast<std::size_t>(index)][static_cast<std::size_t>(y * spec.width + x)];
  }
  [[nodiscard]] std::array<float, 16> matrix(const char* name) const {
    const auto* attribute = spec.find_attribute(name, OIIO::TypeMatrix44);
    if (attribute == nullptr) throw std::runtime_error(name);
    std::array<float, 16> values{};
    std::copy_n(static_cast<const float*>(attribute->data()), 16, values.begin());
    return values;
  }

  OIIO::ImageSpec spec;

 private:
  /// Without OpenImageIO's conversion, which maps integers to 0 .. 1.
  template <class T>
  std::vector<double> read_channel(OIIO::ImageInput& input, int channel) const {
    std::vector<T> samples(static_cast<std::size_t>(spec.width * spec.height));
    input.read_image(0, 0, channel, channel + 1, OIIO::BaseTypeFromC<T>::value, samples.data());
    return {samples.begin(), samples.end()};
  }

  std::vector<std::vector<double>> channels_;
};

using Point = std::array<double, 3>;

/// (p, 1) M.
std::array<double, 4> transform(const Point& p, const std::array<float, 16>& m) {
  std::array<double, 4> result{};
  for (std::size_t c = 0; c < 4; ++c) {
    result[c] = static_cast<double>(m[12 + c]);
    for (std::size_t r = 0; r < 3; ++r) result[c] += p[r] * static_cast<double>(m[4 * r + c]);
  }
  return result;
}

class Picture : public ProgramTest {
 protected:
  std::string render(const std::string& scene, std::vector<std::string> options,
                     const std::string& name = "out.exr",
                     const std::vector<std::string>& environment = {}) const {
    std::vector<std::string> arguments = {"render", scene, "-o", path(name), "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = boule_run(arguments, environment);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path(name);
  }
  [[nodiscard]] std::string orthographic_scene() const {
    return write("ortho.toml", R"(schema = 1
[image]
size = [24, 16]
[camera]
type = "orthographic"
eye = [3.0, 2.0, 5.0]
look_at = [0.0, 0.5, 0.0]
height = 4.0
[[sphere]]
center = [0.0, 1.0, 0.0]
radius = 1.0
[[plane]]
point = [0.0, 0.0, 0.0]
normal = [0.0, 1.0, 0.0]
)");
  }
};

TEST_F(Picture, OneFileHoldsAnySubsetOfViews) {
  const std::string scene = small_scene();
  const auto names = [&](const char* views) {
    return PictureFile(render(scene, {"--aov", views})).spec.channelnames;
  };
  EXPECT_THAT(names("depth"), ElementsAre("R", "G", "B", "Z"));
  EXPECT_THAT(names("normal"), ElementsAre("R", "G", "B", "N.X", "N.Y", "N.Z"));
  EXPECT_THAT(names("position"), ElementsAre("R", "G", "B", "P.X", "P.Y", "P.Z"));
  EXPECT_THAT(names("id"), ElementsAre("R", "G", "B", "id"));
  EXPECT_THAT(names("albedo"), ElementsAre("R", "G", "B", "albedo.R", "albedo.G", "albedo.B"));
  EXPECT_EQ(names("albedo,position,id,normal,depth").size(), 14u);
  EXPECT_EQ(PictureFile(render(scene, {})).spec.nchannels, 3);
}

TEST_F(Picture, ViewsShowPixelCentresAndMarkMisses) {
  const PictureFile file(render(small_scene(), {"--aov", all_views, "--spp", "5"}));
  EXPECT_EQ(file.spec.channelformat(file.spec.channelindex("id")), OIIO::TypeDesc::UINT32);
  EXPECT_EQ(file.spec.channelformat(file.spec.channelindex("Z")), OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(file.at("id", 16, 9), 0);  // the sphere
  EXPECT_EQ(file.at("id", 2, 17), 1);  // the plane
  EXPECT_EQ(file.at("Z", 0, 0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(file.at("id", 0, 0), 4294967295.0);
  for (const char* channel :
       {"N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "albedo.R", "albedo.G", "albedo.B"}) {
    EXPECT_EQ(file.at(channel, 0, 0), 0) << channel;
  }
  EXPECT_EQ(file.at("N.Y", 2, 17), 1);
  EXPECT_EQ(file.at("P.Y", 2, 17), 0);
  EXPECT_EQ(file.at("albedo.R", 2, 17), static_cast<double>(0.45F));
  const double x = file.at("P.X", 16, 9), y = file.at("P.Y", 16, 9), z = file.at("P.Z", 16, 9);
  EXPECT_NEAR(x * x + (y - 1) * (y - 1) + z * z, 1, 1e-6);
  EXPECT_NEAR(file.at("Z", 16, 9), std::hypot(x, y - 1, z - 5), 1e-6);
}

/// The matrices say where the pixels of the position channels lie: in the camera's space at the
/// depth, on the screen at the pixel's centre.
TEST_F(Picture, TheMatricesTakePositionsToTheirPixels) {
  for (const std::string& scene : {small_scene(), orthographic_scene()}) {
    for (const std::vector<std::string>& crop :
         std::vector<std::vector<std::string>>{{}, {"--crop", "5,3,17,14"}}) {
      auto options = crop;
      options.insert(options.end(), {"--aov", all_views});
      const PictureFile file(render(scene, options));
      const auto camera = file.matrix("worldtocamera"), screen = file.matrix("worldtoscreen");
      const double width = file.spec.full_width, height = file.spec.full_height;
      int hits = 0;
      for (int j = 0; j < file.spec.height; ++j) {
        for (int i = 0; i < file.spec.width; ++i) {
          if (!std::isfinite(file.at("Z", i, j))) continue;
          ++hits;
          const Point p = {file.at("P.X", i, j), file.at("P.Y", i, j), file.at("P.Z", i, j)};
          const auto c = transform(p, camera);
          const auto s = transform(p, screen);
          const bool perspective = screen[15] != 1;
          const double depth = perspective ? std::hypot(c[0], c[1], c[2]) : c[2];
          ASSERT_NEAR(depth / file.at("Z", i, j), 1, 1e-6);
          // 1e-6 of the film: floats of about 5 units, seen from as far.
          ASSERT_NEAR(s[0] / s[3], (2 * (i + file.spec.x + 0.5) - width) / width, 2e-6);
          ASSERT_NEAR(s[1] / s[3], (height - 2 * (j + file.spec.y + 0.5)) / height, 2e-6);
          ASSERT_NEAR(s[2] / s[3], perspective ? 1 / c[2] : c[2], 1e-5);
        }
      }
      EXPECT_GT(hits, 30);
    }
  }
}

TEST_F(Picture, CurvedProjectionsHaveNoScreenMatrix) {
  const std::string start = "schema = 1\n[camera]\neye = [0, 1, 5]\nlook_at = [0, 0, 0]\n";
  const auto has_screen = [&](const std::string& name, const std::string& keys) {
    const PictureFile file(render(write(name, start + keys), {"--size", "32x18"}));
    EXPECT_NE(file.spec.find_attribute("worldtocamera"), nullptr);
    return file.spec.find_attribute("worldtoscreen") != nullptr;
  };
  EXPECT_FALSE(has_screen("fisheye.toml", "type = \"fisheye\"\n"));
  EXPECT_TRUE(has_screen("lens.toml", "type = \"thin_lens\"\naperture = 0.1\n"));
  EXPECT_FALSE(has_screen("real.toml",
                          "type = \"lens\"\nfile = \"" BOULE_SCENES "/double_gauss_50mm.lens\"\n"));
  EXPECT_FALSE(has_screen("distorted.toml",
                          "[camera.distortion]\nfile = \"" BOULE_SCENES "/barrel.exr\"\n"));
}

TEST_F(Picture, HeaderTellsTheOriginOfPositions) {
  const std::string scene = write("origin.toml",
                                  "schema = 1\norigin = [1e6, 0.125, -2]\n[camera]\n"
                                  "eye = [1e6, 0, 5]\nlook_at = [1e6, 0, 0]\n"
                                  "[[sphere]]\ncenter = [1e6, 0, 0]\n");
  const PictureFile file(render(scene, {"--size", "1x1", "--aov", "position"}));
  EXPECT_EQ(file.spec.get_string_attribute("boule:origin"), "1000000 0.125 -2");
  EXPECT_EQ(file.at("P.X", 0, 0), 0);
  EXPECT_EQ(file.at("P.Y", 0, 0), -0.125F);
  EXPECT_EQ(file.at("P.Z", 0, 0), 3);
}

TEST_F(Picture, TheHeaderSaysHowItWasMade) {
  const std::string scene = small_scene();
  const PictureFile file(render(scene, {"--spp", "3", "--seed", "18446744073709551615"}));
  EXPECT_THAT(std::string(file.spec.get_string_attribute("Software")), HasSubstr("boule "));
  EXPECT_EQ(file.spec.get_string_attribute("DateTime"), "1970:01:01 00:00:00");
  EXPECT_EQ(file.spec.get_int_attribute("samplesPerPixel"), 3);
  EXPECT_EQ(file.spec.get_string_attribute("boule:solver"), "robust");
  EXPECT_EQ(file.spec.get_string_attribute("boule:seed"), "18446744073709551615");
  EXPECT_EQ(file.spec.get_string_attribute("oiio:ColorSpace"), "Linear");
  EXPECT_EQ(file.spec.find_attribute("boule:origin"), nullptr);  // it is 0
  const std::string hash = file.spec.get_string_attribute("boule:scene_hash");
  EXPECT_EQ(hash.size(), 16u);
  EXPECT_THAT(boule_run({"info", scene}).out, HasSubstr("hash: " + hash + "\n"));
  for (const char* solver : {"fast", "reference"}) {
    const PictureFile other(render(scene, {"--solver", solver}));
    EXPECT_EQ(other.spec.get_string_attribute("boule:solver"), solver);
  }
}

TEST_F(Picture, TheHeaderSaysHowLightWasFollowed) {
  const std::string scene = small_scene();
  const auto expect = [&](const std::vector<std::string>& options, const std::string& method,
                          const std::string& filter, const std::string& max_depth,
                          const std::string& seed) {
    const PictureFile file(render(scene, options));
    EXPECT_EQ(file.spec.get_string_attribute("boule:method"), method);
    EXPECT_EQ(file.spec.get_string_attribute("boule:filter"), filter);
    EXPECT_EQ(file.spec.get_string_attribute("boule:max_depth"), max_depth);
    EXPECT_EQ(file.spec.get_string_attribute("boule:seed"), seed);
  };
  expect({}, "whitted", "box", "5", "0");
  expect({"--method=path", "--filter=tent", "--max-depth=0", "--seed=7"}, "path", "tent", "0", "7");
}

TEST_F(Picture, TheSourceDateIsTheFilesDate) {
  const std::string scene = small_scene();
  const std::pair<const char*, const char*> dates[] = {{"0", "1970:01:01 00:00:00"},
                                                       {"951782400", "2000:02:29 00:00:00"},
                                                       {"1700000000", "2023:11:14 22:13:20"},
                                                       {"253402300799", "9999:12:31 23:59:59"}};
  for (const auto& [seconds, date] : dates) {
    const PictureFile file(render(scene, {}, "out.exr",
                                  {std::string("SOURCE_DATE_EPOCH=") + seconds, "TZ=Asia/Tokyo"}));
    EXPECT_EQ(file.spec.get_string_attribute("DateTime"), date);
  }
}

TEST_F(Picture, EqualRendersAreEqualFiles) {
  const std::string scene = small_scene();
  for (const char* name : {"x.exr", "x.png", "x.jpg", "x.tif", "x.hdr", "x.webp"}) {
    const bool exr = std::string(name) == "x.exr";
    const auto bytes = [&](std::vector<std::string> options) {
      if (exr) options.insert(options.end(), {"--aov", all_views});
      options.insert(options.end(), {"--spp", "2"});
      render(scene, options, name);
      return read(name);
    };
    const std::string expected = bytes({"--isa", "scalar", "-t", "1"});
    EXPECT_EQ(bytes({"-t", "3", "--order", "frameless", "--tile", "5"}), expected) << name;
    if (!exr) continue;
    for (const IsaInfo& info : list_isas()) {
      if (!info.supported) continue;
      EXPECT_EQ(bytes({"--isa", std::string(info.name), "-t", "2"}), expected) << info.name;
    }
  }
}

TEST_F(Picture, ACropLiesInItsFrame) {
  const std::string scene = small_scene();
  const PictureFile frame(render(scene, {"--aov", all_views}, "frame.exr"));
  const PictureFile crop(render(scene, {"--aov", all_views, "--crop", "5,3,17,11"}, "crop.exr"));
  EXPECT_EQ(crop.spec.x, 5);
  EXPECT_EQ(crop.spec.y, 3);
  EXPECT_EQ(crop.spec.width, 12);
  EXPECT_EQ(crop.spec.height, 8);
  EXPECT_EQ(crop.spec.full_width, 32);
  EXPECT_EQ(crop.spec.full_height, 18);
  EXPECT_EQ(crop.matrix("worldtoscreen"), frame.matrix("worldtoscreen"));
  for (const std::string& channel : frame.spec.channelnames) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 12; ++x) {
        ASSERT_EQ(crop.at(channel.c_str(), x, y), frame.at(channel.c_str(), x + 5, y + 3))
            << channel;
      }
    }
  }
}

}  // namespace
}  // namespace boule::test
