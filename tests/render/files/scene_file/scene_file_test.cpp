#include "render/files/scene_file/scene_file.h"

#include <sys/stat.h>

#include <filesystem>

#include "render/files/file/nearest_name.h"
#include "tests/render/files/scene_file/scene_folder.h"

// What is a scene file at all, before anything in it is read.

namespace boule {
namespace {

using test::SceneFolder;

void expect_unreadable(const std::string& path, const std::string& reason) {
  const auto loaded = load_scene(path);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().file, path);
  EXPECT_EQ(loaded.error().line, 0);
  EXPECT_EQ(loaded.error().message, "cannot read it: " + reason);
}

TEST(SceneFile, MissingFile) {
  expect_unreadable(SceneFolder{}.path("none.toml"), "No such file or directory");
}

TEST(SceneFile, Directory) {
  const SceneFolder files;
  std::filesystem::create_directory(files.path("folder.toml"));
  expect_unreadable(files.path("folder.toml"), "it is a directory, expected a regular file");
}

TEST(SceneFile, FifoIsRefusedWithoutWaiting) {
  const SceneFolder files;
  ASSERT_EQ(mkfifo(files.path("pipe.nff").c_str(), 0600), 0);
  expect_unreadable(files.path("pipe.nff"), "it is a FIFO, expected a regular file");
}

TEST(SceneFile, DeviceBehindALink) {
  const SceneFolder files;
  std::filesystem::create_symlink("/dev/zero", files.path("zero.toml"));
  expect_unreadable(files.path("zero.toml"), "it is a device, expected a regular file");
}

TEST(SceneFile, LinkToARegularFile) {
  const SceneFolder files;
  std::filesystem::create_symlink(files.write("a.toml", "schema = 1\n"), files.path("b.toml"));
  EXPECT_TRUE(load_scene(files.path("b.toml")).ok());
}

TEST(SceneFile, LinkToItself) {
  const SceneFolder files;
  std::filesystem::create_symlink("a.toml", files.path("a.toml"));
  expect_unreadable(files.path("a.toml"), "Too many levels of symbolic links");
}

TEST(SceneFile, UnreadableFile) {
  // Permissions do not bind root; a name that is too long fails for everybody.
  const SceneFolder files;
  expect_unreadable(files.path(std::string(300, 'a') + ".toml"), "File name too long");
}

TEST(SceneFile, ExtensionsInEitherCase) {
  const SceneFolder files;
  EXPECT_TRUE(files.load("A.TOML", "schema = 1\n").ok());
  const auto nff = files.load("A.Nff", "what\n");
  ASSERT_FALSE(nff.ok());
  EXPECT_EQ(nff.error().key, "what");
}

TEST(SceneFile, OtherExtensions) {
  for (const char* name : {"a.txt", "toml", "nff", "a.toml.bak"}) {
    const auto loaded = SceneFolder{}.load(name, "schema = 1\n");
    ASSERT_FALSE(loaded.ok());
    EXPECT_THAT(loaded.error().file, testing::EndsWith(name));
    EXPECT_THAT(loaded.error().message,
                testing::HasSubstr("expected an extension .toml, .nff, .npy or .boule"));
  }
  for (const char* name : {"none.txt", ""}) {
    const auto loaded = load_scene(name);
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().file, name);
    EXPECT_THAT(loaded.error().message, testing::StartsWith("cannot read it: "));
  }
}

TEST(SceneFile, Utf16IsNamed) {
  for (const std::string& mark : {std::string("\xff\xfe"), std::string("\xfe\xff")}) {
    const auto loaded = SceneFolder{}.load("a.toml", mark + std::string("s\0c\0", 4));
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().message, "is UTF-16 text, expected UTF-8");
    EXPECT_EQ(loaded.error().line, 1);
  }
}

TEST(SceneFile, NulBytesHaveAPlace) {
  for (const char* name : {"a.toml", "a.nff"}) {
    const auto loaded = SceneFolder{}.load(name, std::string("# ok\n# a\0b", 10));
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().message, "holds a NUL byte, expected UTF-8 text");
    EXPECT_EQ(loaded.error().line, 2);
    EXPECT_EQ(loaded.error().column, 4);
  }
}

TEST(NearestName, SlipsOfTheKeyboard) {
  const std::vector<std::string_view> known = {"eye", "look_at", "up", "fov", "fov_axis"};
  EXPECT_EQ(did_you_mean("eey", known), "; did you mean 'eye'?");
  EXPECT_EQ(did_you_mean("lokat", known), "");
  EXPECT_EQ(did_you_mean("lookat", known), "; did you mean 'look_at'?");
  EXPECT_EQ(did_you_mean("fov_axsi", known), "; did you mean 'fov_axis'?");
  EXPECT_EQ(did_you_mean("u", known), "; did you mean 'up'?");
  EXPECT_EQ(did_you_mean("radius", known), "");
  EXPECT_EQ(did_you_mean(std::string(1000000, 'e'), known), "");
}

TEST(NearestName, Lists) {
  EXPECT_EQ(list_names({"a"}), "'a'");
  EXPECT_EQ(list_names({"a", "b"}), "'a' or 'b'");
  EXPECT_EQ(list_names({"a", "b", "c"}), "'a', 'b' or 'c'");
}

}  // namespace
}  // namespace boule
