// Texts of any length and bytes in a picture's header. Libraries below OpenImageIO abort or exit
// over some of them, so each test runs in a child process, which must come to its end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>

#include "core/base/version.h"
#include "render/image/write_image.h"
#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

constexpr const char* extensions[] = {"exr",  "hdr", "png", "jpg", "tif",
                                      "webp", "ppm", "bmp", "tga"};
constexpr const char* names[] = {"ImageDescription", "Copyright",    "Artist",       "Software",
                                 "IPTC:Caption",     "DocumentName", "HostComputer", "DateTime",
                                 "Exif:UserComment", "XMP:Label",    "Keywords",     "boule:note"};

std::string repeated(const std::string& what, std::size_t bytes) {
  std::string text;
  while (text.size() < bytes) text += what;
  return text;
}

/// Runs `work` in a child process. Returns what it logged of each case, with "whole" at its end.
/// Nothing may appear on standard error.
std::string run_in_child(const TempDir& folder, const std::function<void(std::FILE*)>& cases) {
  const std::string log = (folder.path() / "log").string();
  const pid_t child = ::fork();
  if (child == 0) {
    std::FILE* const out = std::fopen(log.c_str(), "w");
    if (std::freopen((log + ".err").c_str(), "w", stderr) == nullptr) ::_exit(2);
    cases(out);
    std::fputs("whole\n", out);
    std::fclose(out);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(read_bytes(log + ".err"), "");
  return read_bytes(log);
}

/// A name that leads to /dev/null, where no data have to be made durable.
std::string to_nowhere(const TempDir& folder, const std::string& extension) {
  const auto path = folder.path() / ("a." + extension);
  std::filesystem::create_symlink("/dev/null", path);
  return path.string();
}

/// Writes one picture with this text, after a line about it in the log.
std::string write_with(std::FILE* log, const std::string& path, const std::string& name,
                       const std::string& text) {
  ImageFileOptions options;
  options.metadata = {{name, text}};
  std::fprintf(log, "%s: '%s' of %zu bytes: ", path.c_str(), name.c_str(), text.size());
  std::fflush(log);
  const Status written = write_image(Image(4, 4), path, options);
  std::fprintf(log, "%s\n", written ? "done" : written.error().message.c_str());
  return written ? "" : written.error().message;
}

/// Writes every text under every name in every format. What is refused is refused by its name.
TEST(Metadata, NoTextEndsTheProcess) {
  const TempDir folder;
  const std::string texts[] = {"",
                               "x",
                               std::string(50'000, 'x'),
                               std::string(65'000, 'x'),
                               std::string(100'000, '&'),
                               repeated("a;", 24'000),  // a list, with a length for each part
                               repeated("\x01\x1f\x7f\n\r\t", 100),
                               repeated("\xff\xfe\x80", 100),
                               std::string("\0a", 2),
                               repeated("%s%n{}\x1b]0;title\a", 60)};
  const std::string log = run_in_child(folder, [&](std::FILE* out) {
    for (const std::string extension : extensions) {
      const std::string path = to_nowhere(folder, extension);
      for (const std::string name : names) {
        for (const std::string& text : texts) {
          const std::string reason = write_with(out, path, name, text);
          const auto parts = static_cast<std::size_t>(std::count(text.begin(), text.end(), ';'));
          const bool refused = extension == "jpg" && text.size() + 8 * parts > 60'000;
          if (refused !=
              reason.starts_with("cannot write '" + path + "': metadata '" + name + "' has"))
            std::fputs("unexpected\n", out);
          if (!refused && !reason.empty()) std::fputs("unexpected\n", out);
        }
      }
    }
  });
  EXPECT_THAT(log, testing::EndsWith("whole\n"));
  EXPECT_THAT(log, testing::Not(testing::HasSubstr("unexpected")));
}

TEST(Metadata, ManyHugeOrOddEntriesAreHarmless) {
  const TempDir folder;
  const std::string log = run_in_child(folder, [&](std::FILE* out) {
    for (const std::string extension : extensions) {
      const std::string path = to_nowhere(folder, extension);
      ImageFileOptions options;
      for (const std::string name : names)
        options.metadata.emplace_back(name, std::string(4000, 'x'));
      const Status many = write_image(Image(4, 4), path, options);
      std::fprintf(out, "%s of many\n", many ? "done" : many.error().message.c_str());
      write_with(out, path, "ImageDescription", std::string(10'000'000, 'x'));
      const std::string huge = write_with(out, path, "Artist", std::string(17'000'000, 'x'));
      if (huge.find("metadata 'Artist' has 17000000 bytes") == std::string::npos)
        std::fputs("unexpected\n", out);
      for (const std::string& name : {std::string("\x01"), std::string("a\nb"),
                                      std::string(256, 'n'), std::string("ICCProfile")})
        if (write_with(out, path, name, "x").empty()) std::fputs("unexpected\n", out);
      for (const std::string name : {"", "%s", ":", "XMP:", "\xff", "a b"})
        if (!write_with(out, path, name, "x").empty()) std::fputs("unexpected\n", out);
    }
  });
  EXPECT_THAT(log, testing::EndsWith("whole\n"));
  EXPECT_THAT(log, testing::Not(testing::HasSubstr("unexpected")));
}

/// An empty text asks for no entry, not even the standard one.
TEST(Metadata, AnEmptyTextMeansNoEntry) {
  const TempDir folder;
  const auto bytes_with = [&](const Metadata& metadata) {
    ImageFileOptions options;
    options.metadata = metadata;
    const std::string path = (folder.path() / "a.exr").string();
    const Status done = write_image(Image(4, 4), path, options);
    EXPECT_TRUE(done) << done.error().message;
    return read_bytes(path);
  };
  EXPECT_THAT(bytes_with({}), testing::HasSubstr("boule " + std::string(library_version())));
  EXPECT_THAT(bytes_with({{"Software", ""}}), testing::Not(testing::HasSubstr("Software")));
  EXPECT_THAT(bytes_with({{"Software", ""}, {"Software", "mine"}}), testing::HasSubstr("mine"));
  EXPECT_THAT(bytes_with({{"note", "one"}, {"note", ""}}),
              testing::Not(testing::HasSubstr("note")));
  EXPECT_EQ(bytes_with({{"", 1}, {"", "x"}}), bytes_with({}));
}

}  // namespace
}  // namespace boule::test
