#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "render/files/scene_file/scene_file.h"
#include "tests/scenes/shipped.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

/// The fenced blocks of one language in a Markdown text.
std::vector<std::string> code_blocks(const std::string& markdown, const std::string& language) {
  const std::string open = "\n```" + language + "\n", close = "\n```\n";
  std::vector<std::string> blocks;
  for (std::size_t at = 0; (at = markdown.find(open, at)) != std::string::npos;) {
    const std::size_t begin = at + open.size();
    at = markdown.find(close, begin);
    if (at == std::string::npos) break;
    blocks.push_back(markdown.substr(begin, at - begin + 1));
  }
  return blocks;
}

/// What `np.save` writes for two float32 rows of so many zeros.
std::string two_rows(std::size_t columns) {
  std::string dict =
      "{'descr': '<f4', 'fortran_order': False, 'shape': (2, " + std::to_string(columns) + "), }";
  dict.resize(117, ' ');
  return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + dict + '\n' +
         std::string(2 * columns * sizeof(float), '\0');
}

/// Where the format is described.
std::filesystem::path scene_format() { return documents_folder() / "scene_format.md"; }

/// A folder with the data files that the documents' scenes name.
class DocumentFolder {
 public:
  DocumentFolder() {
    write("cloud.npy", two_rows(3));
    write("bonds.npy", two_rows(6));
    write("water.xyz", code_blocks(read_bytes(scene_format()), "text").front());
    for (const char* name :
         {"sphereflake.npy", "barrel.exr", "sky.exr", "double_gauss_50mm.lens"}) {
      write(name, read_bytes(scenes_folder() / name));
    }
  }
  [[nodiscard]] Result<LoadedScene> load(const std::string& name, const std::string& text) const {
    return load_scene(write(name, text));
  }

 private:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (dir_.path() / name).string();
  }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

  TempDir dir_;
};

void expect_all_load(const std::filesystem::path& page, const std::string& language,
                     std::size_t at_least) {
  const DocumentFolder folder;
  const auto blocks = code_blocks(read_bytes(page), language);
  EXPECT_GE(blocks.size(), at_least);
  for (const std::string& block : blocks) {
    const auto loaded = folder.load("block." + language, block);
    EXPECT_TRUE(loaded.ok()) << block << format_diagnostic(loaded.error());
  }
}

TEST(Documents, EveryTomlBlockIsAScene) { expect_all_load(scene_format(), "toml", 7); }

TEST(Documents, EveryNffBlockIsAScene) { expect_all_load(scene_format(), "nff", 1); }

/// The names in quotes after "expected" in a Diagnostic's message.
std::vector<std::string> expected_names(const std::string& message) {
  std::vector<std::string> names;
  std::size_t at = message.find("expected");
  while ((at = message.find('\'', at)) != std::string::npos) {
    const std::size_t end = message.find('\'', at + 1);
    names.push_back(message.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return names;
}

TEST(Documents, NameEveryKeyOfTheReader) {
  const std::string page = read_bytes(scene_format());
  const DocumentFolder folder;
  // A reader lists the keys it knows in its error about one that it does not.
  for (const char* table : {"[image]",
                            "[render]",
                            "[camera]",
                            "[camera]\ntype='orthographic'",
                            "[camera]\ntype='fisheye'",
                            "[camera]\ntype='thin_lens'",
                            "[camera]\ntype='lens'",
                            "[background]",
                            "[background]\ntype='gradient'",
                            "[background]\ntype='environment'",
                            "[[light]]",
                            "[[light]]\ntype='directional'",
                            "[[light]]\ntype='sphere'",
                            "[material.a]",
                            "[material.a]\ntype='plastic'",
                            "[material.a]\ntype='metal'",
                            "[material.a]\ntype='glass'",
                            "[material.a]\ntype='emissive'",
                            "[material.a]\ntype='phong'",
                            "[[sphere]]",
                            "[[spheres]]",
                            "[[particles]]",
                            "[[particles]]\n[particles.color]",
                            "[[plane]]",
                            "[[capsule]]",
                            "[[capsules]]",
                            "[[instance]]",
                            "[group.a]",
                            "[[camera.key]]"}) {
    const auto loaded = folder.load("key.toml", "schema=1\n" + std::string(table) + "\nzzzzzz=1\n");
    ASSERT_FALSE(loaded.ok()) << table;
    const auto names = expected_names(loaded.error().message);
    EXPECT_GE(names.size(), 2U) << loaded.error().message;
    for (const std::string& key : names) {
      const bool is_there = page.find('`' + key + '`') != std::string::npos ||
                            page.find('.' + key + '`') != std::string::npos;
      EXPECT_TRUE(is_there) << table << " " << key;
    }
  }
}

}  // namespace
}  // namespace boule::test
