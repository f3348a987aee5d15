#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <string>

#include "render/files/scene_file/scene_file.h"
#include "render/image/read_image.h"
#include "render/image/write_image.h"
#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"
#include "render/renderer/renderer.h"
#include "render/renderer/tracer.h"
#include "tests/render/npy_files.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

TEST(Memory, AvailableMemoryIsPlausible) {
  EXPECT_GT(available_memory(), std::uint64_t{1} << 20);
  EXPECT_LT(available_memory(), std::uint64_t{1} << 50);
}

/// While it lives, this process cannot map more than so many bytes.
class AddressLimit {
 public:
  explicit AddressLimit(std::uint64_t bytes) {
    getrlimit(RLIMIT_AS, &saved_);
    const rlimit limit{bytes, saved_.rlim_max};
    set_ = setrlimit(RLIMIT_AS, &limit) == 0;
  }
  ~AddressLimit() { setrlimit(RLIMIT_AS, &saved_); }
  [[nodiscard]] bool holds() const { return set_; }

 private:
  rlimit saved_{};
  bool set_ = false;
};

std::uint64_t used_addresses() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

/// How much the heap may grow or shrink while a file is read: some 100 KiB were measured.
constexpr std::uint64_t heaps_breath = std::uint64_t{1} << 20;

TEST(Memory, IsWhatTheLimitOnAddressesLeaves) {
  constexpr std::uint64_t room = std::uint64_t{100} << 20;
  const AddressLimit limit(used_addresses() + room);
  ASSERT_TRUE(limit.holds());
  EXPECT_NEAR(static_cast<double>(address_room()), static_cast<double>(room), heaps_breath);
  EXPECT_LE(available_memory(), room + heaps_breath);
  EXPECT_GT(available_memory(), std::uint64_t{10} << 20);
  const auto refused = check_memory(room + 2 * heaps_breath, "a thing needs", "thing");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message.find("a thing needs 102 MiB of memory, there are "), 0u);
  EXPECT_EQ(refused.error().key, "thing");
  EXPECT_TRUE(check_memory(1 << 20, "a thing needs"));
}

/// The stacks of threads and all memory from malloc count as data.
TEST(Memory, IsWhatTheLimitOnDataLeaves) {
  constexpr std::uint64_t room = std::uint64_t{100} << 20;
  rlimit saved{};
  getrlimit(RLIMIT_DATA, &saved);
  std::ifstream status("/proc/self/status");
  std::string word;
  std::uint64_t kibibytes = 0;
  while (word != "VmData:" && status >> word) {
  }
  ASSERT_TRUE(status >> kibibytes);
  const rlimit limit{kibibytes * 1024 + room, saved.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &limit), 0);
  const ProcessRoom found = process_room();
  const std::uint64_t least = address_room(), available = available_memory();
  setrlimit(RLIMIT_DATA, &saved);
  EXPECT_NEAR(static_cast<double>(found.data), static_cast<double>(room), heaps_breath);
  EXPECT_GT(found.addresses, room + heaps_breath);
  EXPECT_LE(least, room + heaps_breath);
  EXPECT_LE(available, room + heaps_breath);
}

class MemoryFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return (folder_.path() / name).string();
  }
  std::string folder() const { return folder_.path().string(); }

 private:
  TempDir folder_;
};

TEST_F(MemoryFiles, ControlGroupLimitsCount) {
  constexpr auto unlimited = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(control_group_memory(folder()), unlimited);
  write("memory.max", "max\n");
  EXPECT_EQ(control_group_memory(folder()), unlimited);
  write("memory.max", "1000000\n");
  EXPECT_EQ(control_group_memory(folder()), 1000000u);
  write("memory.current", "700000\n");
  write("memory.stat", "anon 1\nactive_file 20000\ninactive_file 300000\nslab 3\n");
  EXPECT_EQ(control_group_memory(folder()), 1000000u - (700000 - 320000));
  write("memory.current", "2000000\n");
  EXPECT_EQ(control_group_memory(folder()), 0u);
}

/// A scene whose groups each show the next one ten times, which makes 10^levels spheres.
Scene tenfold(int levels) {
  Scene scene = empty_scene(8, 8);
  add_material(scene, Matte{});
  scene.groups.push_back({"0", {{{0, 0, 0}, 1, 0}}, {}, {}});
  for (int i = 1; i < levels; ++i) {
    Group group{std::to_string(i), {}, {}, {}};
    group.instances.resize(10, {static_cast<std::uint32_t>(i - 1), {1, 0, 0}, {}, 0.5f, {}});
    scene.groups.push_back(group);
  }
  scene.instances.resize(10, {static_cast<std::uint32_t>(levels - 1), {}, {}, 1, {}});
  return scene;
}

/// A limit of one second of this process's CPU time.
class Limit {
 public:
  [[nodiscard]] bool holds() const { return std::clock() - begin_ < CLOCKS_PER_SEC; }

 private:
  std::clock_t begin_ = std::clock();
};

TEST(Memory, RefusesInstancesBeforeExpandingThem) {
  if (available_memory() > bytes_of_tree(1000000000)) GTEST_SKIP() << "it fits into this machine";
  const Scene scene = tenfold(9);
  const Limit second;
  const auto renderer = Renderer::create(scene, options_of(scene));
  const auto tracer = Tracer::create(scene);
  EXPECT_TRUE(second.holds());
  ASSERT_FALSE(renderer);
  EXPECT_EQ(renderer.error().key, "instance");
  EXPECT_EQ(renderer.error().message.find(
                "1000000000 spheres and planes, with those of the instances, need "),
            0u);
  ASSERT_FALSE(tracer);
  EXPECT_EQ(tracer.error().key, "instance");
}

TEST(Memory, OverflowingCountsAreRefused) {
  for (const int levels : {10, 19, 20, 39, 200}) {
    const Scene scene = tenfold(levels);
    const Limit second;
    const Status done = validate(scene);
    EXPECT_TRUE(second.holds());
    ASSERT_FALSE(done) << levels;
    EXPECT_EQ(done.error().message, "with it the scene has more than 2147483647 primitives");
    EXPECT_TRUE(check_scene_memory(scene));
    EXPECT_FALSE(Renderer::create(scene, options_of(scene)));
  }
}

TEST_F(MemoryFiles, InstanceFilesAreRefusedAtOnce) {
  if (available_memory() > bytes_of_tree(1000000000)) GTEST_SKIP() << "it fits into this machine";
  std::string text = "schema = 1\n[group.g0]\n[[group.g0.sphere]]\ncenter = [0, 0, 0]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string name = "group.g" + std::to_string(i);
    text += "[" + name + "]\n";
    for (int k = 0; k < 10; ++k)
      text += "[[" + name + ".instance]]\ngroup = \"g" + std::to_string(i - 1) + "\"\n";
  }
  for (int k = 0; k < 10; ++k) text += "[[instance]]\ngroup = \"g8\"\n";
  const std::string path = write("many.toml", text);
  const Limit second;
  const auto loaded = load_scene(path);
  EXPECT_TRUE(second.holds());
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().key, "instance");
  EXPECT_EQ(loaded.error().file, path);
  EXPECT_GT(loaded.error().line, 1);
}

/// A file with this header and a hole instead of data.
TEST_F(MemoryFiles, TooManySpheresAreRefusedBeforeReading) {
  const std::string header = npy_file(npy_dict("'<f4'", "(2000000000, 4)"), "");
  const std::string cloud = write("cloud.npy", header);
  std::filesystem::resize_file(cloud, header.size() + 32000000000);
  const std::string path = write("scene.toml", "schema = 1\n[[spheres]]\nfile = \"cloud.npy\"\n");
  if (available_memory() > bytes_of_tree(2000000000)) GTEST_SKIP() << "it fits into this machine";
  const Limit second;
  const auto loaded = load_scene(path);
  EXPECT_TRUE(second.holds());
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message.find("2000000000 spheres need "), std::string::npos);
}

TEST_F(MemoryFiles, TooLargeTextsAreRefusedBeforeReading) {
  for (const char* const name : {"scene.toml", "scene.nff"}) {
    const std::string path = write(name, std::string(1 << 20, '\n'));  // it begins like a text
    std::filesystem::resize_file(path, std::uintmax_t{1} << 42);
    const Limit second;
    const auto loaded = load_scene(path);
    EXPECT_TRUE(second.holds());
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().message.find("cannot read it: it needs 4194304 MiB of memory"), 0u)
        << loaded.error().message;
  }
}

/// Four bytes of a number, the lowest first.
void set_int32(std::string& file, std::size_t at, std::int32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    file[at + i] = static_cast<char>(static_cast<std::uint32_t>(value) >> 8 * i & 255);
}

/// An EXR file whose header declares another size.
std::string spoilt_exr(std::string file, std::int32_t width, std::int32_t height) {
  for (const char* const window : {"dataWindow", "displayWindow"}) {
    const std::size_t box =
        file.find(std::string(window) + '\0' + "box2i") + std::string(window).size() + 11;
    set_int32(file, box + 8, width - 1);
    set_int32(file, box + 12, height - 1);
  }
  return file;
}

TEST_F(MemoryFiles, HugePicturesAreRefusedByTheirHeaders) {
  const std::string good = write("good.exr", "");
  Image image(4, 4);
  ASSERT_TRUE(write_image(image, good));
  const std::string file = read_bytes(good);
  struct Case {
    std::int32_t width, height;
  };
  for (const Case& c : {Case{100000, 100000}, Case{65535, 65535}, Case{2000000000, 2000000000},
                        Case{4, 2000000000}, Case{2000000000, 4}, Case{-5, 4}}) {
    const std::string path = write("huge.exr", spoilt_exr(file, c.width, c.height));
    const Limit second;
    const auto read = read_image(path, PictureContent::numbers);
    EXPECT_TRUE(second.holds());
    ASSERT_FALSE(read) << c.width << " x " << c.height;
    RecordProperty(std::to_string(c.width) + "x" + std::to_string(c.height), read.error().message);
  }
}

}  // namespace
}  // namespace boule::test
