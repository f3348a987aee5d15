// Particle files stay open from frame to frame of a series, until they change or are not asked for.
#include "render/files/scene_file/loaded/particle_file_cache.h"

#include <string>

#include "tests/render/files/scene_file/scene_folder.h"

namespace boule {
namespace {

/// `count` frames of one atom each, whose x is the frame's number.
std::string trajectory(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "1\n\nC " + std::to_string(i) + " 0 0\n";
  return text;
}

class ParticleFileCacheTest : public testing::Test {
 protected:
  ParticleFileCacheTest() { write(5); }

  void write(int frames) const { static_cast<void>(files_.write("run.xyz", trajectory(frames))); }

  /// Where the one sphere is in a frame of the series.
  float x_in_frame(int frame) {
    SceneFileOptions options;
    options.frame = frame;
    options.particle_files = &cache_;
    const auto loaded =
        files_.load("scene.toml", "schema = 1\n[[particles]]\nfile = \"run.xyz\"\n", options);
    EXPECT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
    return loaded.ok() ? loaded.value().scene.spheres.at(0).center.x : -1;
  }
  [[nodiscard]] std::shared_ptr<ParticleFile> open(const ParticleFileOptions& options = {}) {
    auto opened = cache_.open(files_.path("run.xyz"), options, serial_for);
    EXPECT_TRUE(opened.ok());
    return opened.ok() ? opened.value() : nullptr;
  }

  test::SceneFolder files_;
  ParticleFileCache cache_;
};

TEST_F(ParticleFileCacheTest, OpensAFileOnce) {
  const auto first = open();
  ASSERT_TRUE(first);
  EXPECT_EQ(open(), first);
  ParticleFileOptions others;
  others.columns = {"species", "x", "y", "z"};
  EXPECT_NE(open(others), first);
  EXPECT_EQ(cache_.size(), 2u);
}

TEST_F(ParticleFileCacheTest, ServesTheFramesOfAScene) {
  static_cast<void>(open());  // with all columns: the scene does not ask for it
  for (int i = 0; i < 5; ++i) EXPECT_EQ(x_in_frame(i), static_cast<float>(i));
  EXPECT_EQ(cache_.size(), 1u);
}

TEST_F(ParticleFileCacheTest, OpensAFileThatHasChangedAnew) {
  EXPECT_EQ(x_in_frame(4), 4);
  write(7);
  EXPECT_EQ(x_in_frame(6), 6);
  EXPECT_EQ(cache_.size(), 1u);
}

TEST_F(ParticleFileCacheTest, ClosesWhatIsNotAskedFor) {
  EXPECT_EQ(x_in_frame(0), 0);
  EXPECT_EQ(cache_.size(), 1u);
  cache_.close_unused();
  EXPECT_EQ(cache_.size(), 0u);
}

TEST_F(ParticleFileCacheTest, KeepsNoFileThatCannotBeOpened) {
  EXPECT_FALSE(cache_.open(files_.path("none.xyz"), {}, serial_for).ok());
  EXPECT_EQ(cache_.size(), 0u);
}

}  // namespace
}  // namespace boule
