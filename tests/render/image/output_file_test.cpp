#include "render/image/output_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

class OutputFileTest : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const {
    return (dir_.path() / name).string();
  }
  [[nodiscard]] Names names() const { return test::names_in(dir_.path()); }
  /// "cannot write 'NAME': REASON" of a failed create, or empty.
  static std::string create_error(const std::string& target) {
    const Result<OutputFile> file = OutputFile::create(target);
    return file.ok() ? "" : file.error().message;
  }
  static Status put(const std::string& target, const std::string& bytes) {
    Result<OutputFile> file = OutputFile::create(target);
    if (!file.ok()) return file.error();
    if (Status done = file.value().write(bytes.data(), bytes.size()); !done) return done;
    return file.value().commit();
  }

 private:
  test::TempDir dir_;
};

mode_t mode_of(const std::string& path) {
  struct stat info {};
  stat(path.c_str(), &info);
  return info.st_mode & 07777;
}

TEST_F(OutputFileTest, AppearsOnCommit) {
  Result<OutputFile> file = OutputFile::create(at("a.npy"));
  ASSERT_TRUE(file.ok());
  EXPECT_TRUE(file.value().write("hello", 5));
  EXPECT_FALSE(fs::exists(at("a.npy")));
  EXPECT_EQ(names(), Names{});  // the temporary file has no name yet
  EXPECT_EQ(test::read_bytes(file.value().path()), "hello");
  EXPECT_TRUE(file.value().commit());
  EXPECT_EQ(names(), Names{"a.npy"});
  EXPECT_EQ(test::read_bytes(at("a.npy")), "hello");
}

TEST_F(OutputFileTest, LeavesNothingWithoutCommit) {
  test::write_bytes(at("a.npy"), "old");
  {
    Result<OutputFile> file = OutputFile::create(at("a.npy"));
    ASSERT_TRUE(file.ok());
    OutputFile moved = std::move(file).value();
    EXPECT_TRUE(moved.write("new", 3));
    EXPECT_EQ(test::read_bytes(moved.path()), "new");
  }
  EXPECT_EQ(names(), Names{"a.npy"});
  EXPECT_EQ(test::read_bytes(at("a.npy")), "old");
}

TEST_F(OutputFileTest, TwoAtOnceDoNotInterfere) {
  Result<OutputFile> one = OutputFile::create(at("a.json"));
  Result<OutputFile> two = OutputFile::create(at("a.json"));
  ASSERT_TRUE(one.ok() && two.ok());
  EXPECT_NE(one.value().path(), two.value().path());
  EXPECT_TRUE(one.value().write("1", 1));
  EXPECT_TRUE(two.value().write("2", 1));
  EXPECT_TRUE(two.value().commit());
  EXPECT_TRUE(one.value().commit());
  EXPECT_EQ(test::read_bytes(at("a.json")), "1");
  EXPECT_EQ(names(), Names{"a.json"});
}

TEST_F(OutputFileTest, NewFilesRespectTheUmask) {
  const mode_t old = umask(027);
  EXPECT_TRUE(put(at("a"), "x"));
  umask(old);
  EXPECT_EQ(mode_of(at("a")), 0640U);
}

TEST_F(OutputFileTest, OldFilesKeepTheirMode) {
  test::write_bytes(at("a"), "old");
  ASSERT_EQ(chmod(at("a").c_str(), 0606), 0);
  EXPECT_TRUE(put(at("a"), "new"));
  EXPECT_EQ(mode_of(at("a")), 0606U);
  EXPECT_EQ(test::read_bytes(at("a")), "new");
}

TEST_F(OutputFileTest, LinksAreFollowed) {
  fs::create_directory(at("sub"));
  test::write_bytes(at("sub/real"), "old");
  fs::create_symlink("sub/real", at("link"));
  fs::create_symlink(at("link"), at("chain"));
  EXPECT_TRUE(put(at("chain"), "new"));
  EXPECT_TRUE(fs::is_symlink(at("chain")));
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(test::read_bytes(at("sub/real")), "new");
  EXPECT_EQ(test::names_in(at("sub")), Names{"real"});
}

/// Independent of the setting fs.protected_symlinks of this system.
TEST_F(OutputFileTest, ForeignLinksInOpenFoldersAreRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make links of others";
  constexpr uid_t somebody = 65534, another = 65533;
  fs::create_directory(at("open"));
  test::write_bytes(at("mine"), "old");
  struct Case {
    mode_t mode;
    uid_t folder, link;
    bool refused;
  };
  const Case cases[] = {{01777, 0, somebody, true},  {01777, another, somebody, true},
                        {01777, somebody, 0, false}, {01777, somebody, somebody, false},
                        {0777, 0, somebody, false},  {01755, 0, somebody, false}};
  for (const auto& [mode, folder, link, refused] : cases) {
    for (const std::string target : {"mine", "missing", "/dev/null"}) {
      const std::string name = at("open/link"), chain = at("chain");
      fs::remove(name), fs::remove(chain);
      fs::create_symlink(target[0] == '/' ? target : at(target), name);
      fs::create_symlink(name, chain);
      ASSERT_EQ(lchown(name.c_str(), link, link), 0);
      ASSERT_EQ(chown(at("open").c_str(), folder, folder), 0);
      ASSERT_EQ(chmod(at("open").c_str(), mode), 0);
      for (const std::string& output : {name, chain}) {
        // (The kernel also checks links that lead to streams.)
        EXPECT_EQ(create_error(output),
                  refused ? "cannot write '" + output + "': Permission denied" : "")
            << target << " " << mode << " " << folder << " " << link;
      }
      EXPECT_EQ(test::read_bytes(at("mine")), "old");
    }
  }
}

TEST_F(OutputFileTest, DanglingLinkMakesItsFile) {
  fs::create_symlink("later", at("link"));
  EXPECT_TRUE(put(at("link"), "x"));
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(test::read_bytes(at("later")), "x");
}

TEST_F(OutputFileTest, LongestNameIsLegal) {
  const std::string name = std::string(251, 'n') + ".exr";
  EXPECT_TRUE(put(at(name), "x"));
  EXPECT_EQ(names(), Names{name});
}

TEST_F(OutputFileTest, RefusalsCarryTheSystemsReason) {
  fs::create_directory(at("dir.png"));
  test::write_bytes(at("file"), "x");
  fs::create_symlink("loop", at("loop"));
  const std::pair<std::string, std::string> cases[] = {
      {at("dir.png"), "Is a directory"},
      {at("new/"), "Is a directory"},
      {at("missing/a.png"), "No such file or directory"},
      {at("file/a.png"), "Not a directory"},
      {at(std::string(256, 'n')), "File name too long"},
      {at("loop"), "Too many levels of symbolic links"},
      {"", "No such file or directory"},
      {"/proc/boule.png", "No such file or directory"},
  };
  for (const auto& [target, reason] : cases) {
    EXPECT_EQ(create_error(target), "cannot write '" + target + "': " + reason);
  }
  EXPECT_EQ(names(), (Names{"dir.png", "file", "loop"}));
}

TEST_F(OutputFileTest, NamesWithNulBytesAreRefused) {
  const std::string name = at("a") + std::string("\0.png", 5);
  EXPECT_THAT(create_error(name), testing::EndsWith("a\\x00.png': its name holds a NUL byte"));
  EXPECT_EQ(names(), Names{});
}

TEST_F(OutputFileTest, FinishedOrMovedFromFilesRefuse) {
  Result<OutputFile> file = OutputFile::create(at("a.npy"));
  OutputFile moved = std::move(file).value();
  for (OutputFile* gone : {&file.value(), &moved}) {
    if (gone == &moved) {
      ASSERT_TRUE(moved.commit());
    }
    EXPECT_FALSE(gone->write("hello", 5));
    EXPECT_FALSE(gone->sync());
    EXPECT_FALSE(gone->commit());
  }
  EXPECT_EQ(names(), Names{"a.npy"});
  EXPECT_EQ(test::read_bytes(at("a.npy")), "");
}

/// In the test above the file is moved from; here it is assigned to, and must drop what it had.
TEST_F(OutputFileTest, MoveAssignmentDropsTheTargetsFile) {
  Result<OutputFile> one = OutputFile::create(at("one.npy"));
  Result<OutputFile> two = OutputFile::create(at("two.npy"));
  ASSERT_TRUE(one.ok() && two.ok());
  const std::string dropped = one.value().path();
  EXPECT_TRUE(one.value().write("1", 1));
  EXPECT_TRUE(two.value().write("2", 1));
  one.value() = std::move(two.value());
  EXPECT_FALSE(fs::exists(dropped));
  OutputFile& gone = two.value();  // NOLINT: that is the test
  EXPECT_EQ(gone.descriptor(), -1);
  EXPECT_EQ(gone.path(), "");
  EXPECT_FALSE(gone.write("3", 1));
  EXPECT_FALSE(gone.write("", 0));
  EXPECT_FALSE(gone.sync());
  EXPECT_FALSE(gone.commit());
  EXPECT_EQ(names(), Names{});
  EXPECT_TRUE(one.value().commit());
  EXPECT_EQ(names(), Names{"two.npy"});
  EXPECT_EQ(test::read_bytes(at("two.npy")), "2");
}

TEST_F(OutputFileTest, SelfAssignmentKeepsTheFile) {
  Result<OutputFile> file = OutputFile::create(at("a.npy"));
  ASSERT_TRUE(file.ok());
  OutputFile& same = file.value();
  same = std::move(file.value());
  EXPECT_TRUE(same.write("1", 1));
  EXPECT_TRUE(same.commit());
  EXPECT_EQ(test::read_bytes(at("a.npy")), "1");
}

TEST_F(OutputFileTest, FinishedStreamsRefuse) {
  Result<OutputFile> file = OutputFile::create("/dev/null");
  ASSERT_TRUE(file.ok());
  EXPECT_TRUE(file.value().write("1", 1));
  EXPECT_TRUE(file.value().commit());
  EXPECT_FALSE(file.value().write("2", 1));
  EXPECT_FALSE(file.value().sync());
  EXPECT_FALSE(file.value().commit());
}

TEST_F(OutputFileTest, FullDiskKeepsTheOldFile) {
  test::write_bytes(at("a"), "old");
  {
    const test::FileSizeLimit limit(10);
    const Status done = put(at("a"), std::string(100, 'x'));
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().message, "cannot write '" + at("a") + "': File too large");
  }
  EXPECT_EQ(test::read_bytes(at("a")), "old");
  EXPECT_EQ(names(), Names{"a"});
}

TEST_F(OutputFileTest, DevicesAreWrittenNotReplaced) {
  EXPECT_TRUE(put("/dev/null", "x"));
  const Status done = put("/dev/full", "x");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "cannot write '/dev/full': No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(OutputFileTest, PipesGetTheWholeFileAtOnce) {
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  const int reader = open(at("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  {
    Result<OutputFile> abandoned = OutputFile::create(at("pipe"));
    ASSERT_TRUE(abandoned.ok());
    EXPECT_TRUE(abandoned.value().write("partial", 7));
  }
  EXPECT_TRUE(put(at("pipe"), "whole"));
  std::array<char, 16> bytes{};
  const ssize_t count = read(reader, bytes.data(), bytes.size());
  close(reader);
  EXPECT_EQ(std::string(bytes.data(), static_cast<std::size_t>(count < 0 ? 0 : count)), "whole");
  EXPECT_EQ(names(), Names{"pipe"});
}

}  // namespace
}  // namespace boule
