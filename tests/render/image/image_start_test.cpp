// What ImageStart loads and starts before the work. Each test runs in a child process, which begins
// without OpenImageIO.
#include "render/image/image_start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "render/image/built_in_table.h"
#include "render/image/read_image.h"
#include "render/image/write_image.h"
#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

std::size_t thread_count() { return names_in("/proc/self/task").size(); }

/// Runs `run` in a forked child, which is killed after a minute. Returns its exit status, or 128
/// plus the signal that ended it.
int run_in_child(const std::function<int()>& run) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);
    ::_exit(run());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string message(const Status& status) { return status ? "" : status.error().message; }

class ImageStartTest : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const {
    return (dir_.path() / name).string();
  }
  [[nodiscard]] std::string picture() const { return at("a." + GetParam()); }
  static ImageFileOptions with_threads(int threads) {
    ImageFileOptions options;
    options.threads = threads;
    return options;
  }

 private:
  TempDir dir_;
};

/// A thread that cannot be had later would end the program after the work.
TEST_P(ImageStartTest, StartsAllThreadsThatWritingUses) {
  const int code = run_in_child([&] {
    for (const int threads : {1, 3, 2}) {
      ImageStart start(picture(), threads);
      if (!start.wait()) return 1;
      if (!start.done()) return 2;
      const std::size_t before = thread_count();
      if (before < 2) return 3;
      for (int time = 0; time < 2; ++time) {
        if (!write_image(noise(200, 300), picture(), with_threads(threads))) return 4;
        if (!read_image(picture(), PictureContent::colors)) return 5;
        if (thread_count() != before) return 6;
      }
    }
    return 0;
  });
  EXPECT_EQ(code, 0);
}

/// A child does not have its parent's thread pools: it does without, or refuses.
TEST_P(ImageStartTest, ForkedChildrenWriteOrReportWhyNot) {
  const bool needs_pool = GetParam() == "exr" || GetParam() == "tif";
  const int code = run_in_child([&] {
    if (!write_image(noise(200, 300), picture(), with_threads(3))) return 1;
    const std::string whole = read_bytes(picture());
    const int child = run_in_child([&] {
      const auto written = write_image(noise(200, 300), at("b." + GetParam()), with_threads(3));
      const auto read = read_image(picture(), PictureContent::colors);
      if (needs_pool) {
        const bool told = message(written).find("was forked from") != std::string::npos && !read &&
                          read.error().message.find("was forked from") != std::string::npos;
        // Other formats go on.
        return told && write_image(noise(20, 30), at("c.png"), with_threads(3)) ? 0 : 2;
      }
      if (!written || !read) return 3;
      return read_bytes(at("b." + GetParam())) == whole ? 0 : 4;
    });
    if (child != 0) return 10 + child;
    // The parent goes on.
    return write_image(noise(200, 300), picture(), with_threads(3)) ? 0 : 5;
  });
  EXPECT_EQ(code, 0);
}

TEST_P(ImageStartTest, ChildrenWriteIfParentsHaveNoPools) {
  const int code = run_in_child([&] {
    if (!write_image(noise(20, 30), at("a.png"), with_threads(1))) return 1;
    return run_in_child(
        [&] { return write_image(noise(200, 300), picture(), with_threads(3)) ? 0 : 2; });
  });
  EXPECT_EQ(code, 0);
}

INSTANTIATE_TEST_SUITE_P(Formats, ImageStartTest,
                         testing::Values("exr", "bmp", "tif", "jpg", "webp", "hdr"),
                         [](const auto& format) { return format.param; });

/// PPM is written without OpenImageIO, and PNG where there is libpng.
TEST(ImageStart, SomeFormatsNeedNothing) {
  const TempDir dir;
  for (const char* name : {"a.png", "a.ppm"}) {
    const std::string path = (dir.path() / name).string();
    if (built_in_table(*find_image_format(path)) == nullptr) continue;
    const int code = run_in_child([&] {
      ImageFileOptions options;
      options.threads = 3;
      ImageStart start(path, options.threads);
      if (!start.done() || !start.wait()) return 1;
      if (!write_image(noise(200, 300), path, options)) return 2;
      if (thread_count() != 1) return 3;
      return read_bytes("/proc/self/maps").find("libOpenImageIO") == std::string::npos ? 0 : 4;
    });
    EXPECT_EQ(code, 0) << name;
  }
}

TEST(ImageStart, UnknownExtensionsAreErrors) {
  ImageStart start("a.xyz", 7);
  EXPECT_THAT(message(start.wait()), testing::HasSubstr("cannot write 'a.xyz': unknown image"));
  EXPECT_THAT(message(start.wait()), testing::HasSubstr("cannot write 'a.xyz': unknown image"));
  EXPECT_TRUE(start.done());
}

}  // namespace
}  // namespace boule::test
