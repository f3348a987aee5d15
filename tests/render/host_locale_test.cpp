// A host may write numbers with commas: what Boule reads and writes stays the same.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <locale>
#include <string>

#include "render/files/scene_file/scene_file.h"
#include "render/image/write_image.h"
#include "render/renderer/scene_hash.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

/// 1.234.567,5 in place of 1234567.5.
class Commas : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// While it lives, the process has such a locale: that of C++, and that of C where localedef can
/// make one in `folder`.
class CommaLocale {
 public:
  explicit CommaLocale(const std::string& folder) {
    const std::string name = "de_DE.UTF-8", command = "localedef -i de_DE -f UTF-8 '" + folder +
                                                      "/" + name + "' >/dev/null 2>&1";
    if (std::system(command.c_str()) == 0) {
      ::setenv("LOCPATH", folder.c_str(), 1);
      has_c_locale_ = std::setlocale(LC_ALL, name.c_str()) != nullptr;
    }
    old_ = std::locale::global(std::locale(std::locale::classic(), new Commas));
    if (has_c_locale_) std::setlocale(LC_ALL, name.c_str());
  }
  ~CommaLocale() {
    std::locale::global(old_);
    std::setlocale(LC_ALL, "C");
    ::unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  [[nodiscard]] bool has_c_locale() const { return has_c_locale_; }

 private:
  std::locale old_;
  bool has_c_locale_ = false;
};

class HostLocale : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (dir_.path() / name).string();
  }
  std::string write(const std::string& name, const std::string& text) const {
    write_bytes(path(name), text);
    return path(name);
  }
  [[nodiscard]] std::string read(const std::string& name) const { return read_bytes(path(name)); }

 private:
  TempDir dir_;
};

TEST_F(HostLocale, ChangesNoSceneAndNoFile) {
  write("flat.lens", "# flat glass\n30.5 4.25 1.5 20.125\n-30.5 0 1 20.125\n");
  const std::string scenes[] = {
      write(
          "scene.toml",
          "schema = 1\n[camera]\ntype = 'lens'\nfile = 'flat.lens'\neye = [0.5, 1234567.5, 6.25]\n"
          "look_at = [0, 1.5e-1, 0]\n[[sphere]]\nradius = 0.7\n"),
      write("scene.nff",
            "v\nfrom 0.5 0.25 5.3\nat 0 0 0\nup 0 1 0\nangle 45.1\nhither 1\nresolution 8 8\n"
            "f 0.1 0.2 0.3 0.4 0.5 3.3 0 1\ns 0.1 1234567.5 0.3 1.5e-1\n")};
  write("far.xyz", "2\n\nC 1000.125 0.5 -2000.25\nC 1000.128 0.501 -2000.25\n");
  const std::string particles = write("particles.toml",
                                      "schema = 1\n[[particles]]\nfile = 'far.xyz'\nradius = "
                                      "0.001\ncolor = {by = 'x', map = 'viridis'}\n");
  const Image image(3, 2);
  ImageFileOptions options;
  options.metadata = {{"boule:real", 1234.5f}, {"boule:whole", 1234567}};
  const auto look = [&](const std::string& prefix) {
    std::string all;
    for (const std::string& scene : scenes) {
      const auto loaded = load_scene(scene);
      all += loaded ? std::to_string(scene_hash(loaded.value().scene)) : loaded.error().message;
      all += '\n';
    }
    const auto loaded = load_scene(particles);
    if (!loaded) return all + loaded.error().message;
    for (const std::string& note : loaded.value().notes) all += note + '\n';
    for (const char* extension : {"exr", "hdr", "png", "jpg", "ppm"}) {
      const std::string name = prefix + "." + extension;
      const Status done = write_image(image, path(name), options);
      all += done ? read(name) : done.error().message;
    }
    return all;
  };
  const std::string plain = look("plain");
  ASSERT_NE(plain.find('\n'), std::string::npos);
  ASSERT_NE(plain.find("1000.12"), std::string::npos);
  ASSERT_NE(plain.find("points are counted from ["), std::string::npos);
  const CommaLocale commas(path(""));
  if (!commas.has_c_locale()) std::printf("localedef makes no locale here: C++'s alone is tried\n");
  EXPECT_EQ(look("local"), plain);
}

}  // namespace
}  // namespace boule::test
