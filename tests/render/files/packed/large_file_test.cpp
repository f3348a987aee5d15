// Counts and offsets of packed scenes are 64-bit: files of 2^31 slots and more, of which the disk
// holds a few pages only.
#include <unistd.h>

#include <cstring>

#include "render/prepare/scene_geometry.h"
#include "render/renderer/tracer.h"
#include "simd/geometry/bvh_builder.h"
#include "tests/render/files/packed/packed_scenes.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

using packed_format::Header;
using packed_format::Kind;
using packed_format::most_slots;
using packed_format::next_page;
using packed_format::page;

/// Writes a file with holes.
class SparseFile {
 public:
  explicit SparseFile(const std::string& path) : path_(path) { write_bytes(path, ""); }

  void put(std::uint64_t offset, const void* bytes, std::size_t count) {
    std::FILE* const file = std::fopen(path_.c_str(), "r+b");
    ASSERT_NE(file, nullptr);
    ASSERT_EQ(::fseeko(file, static_cast<off_t>(offset), SEEK_SET), 0);
    ASSERT_EQ(std::fwrite(bytes, 1, count, file), count);
    ASSERT_EQ(std::fclose(file), 0);
  }
  void section(Kind kind, std::uint32_t chunk, std::uint64_t bytes) {
    header_.section[header_.sections++] = {kind, chunk, end_, bytes, 0};
    end_ = next_page(end_ + bytes);
  }
  [[nodiscard]] std::uint64_t offset(Kind kind, std::uint32_t chunk = 0) const {
    for (const auto& section : header_.section) {
      if (section.kind == kind && section.chunk == chunk) return section.offset;
    }
    return 0;
  }
  bool finish() {
    std::copy_n(packed_format::magic, 8, header_.magic);
    header_.version = packed_format::version;
    header_.file_bytes = end_;
    put(0, &header_, sizeof header_);
    return ::truncate(path_.c_str(), static_cast<off_t>(end_)) == 0;
  }

 private:
  std::string path_;
  Header header_{};
  std::uint64_t end_ = page;
};

class LargeFiles : public PackedTest {
 protected:
  /// A file of chunks with so many slots, with one sphere in the last slot but fifteen of each: at
  /// (10 k, 0, 0) in chunk k.
  bool write_file(const std::vector<std::uint64_t>& slots) {
    PackedContents contents;
    contents.scene = empty_scene(4, 4);
    add_material(contents.scene, Matte{});
    contents.spheres.made_of = {0};
    for (std::uint32_t i = 0; i < slots.size(); ++i) {
      contents.chunks.push_back({slots[i] - 2, 0, {}});
      contents.spheres.count += slots[i] - 2;
      contents.spheres.extremes.push_back(last_sphere(i));
    }
    const std::string bytes = encode(contents);
    SparseFile file(path("large.boule"));
    for (std::uint32_t i = 0; i < slots.size(); ++i) {
      file.section(Kind::blocks, i, slots[i] / bvh_leaf_size * sizeof(SphereBlock));
      file.section(Kind::ids, i, slots[i] * sizeof(std::int32_t));
      file.section(Kind::nodes, i, sizeof(BvhNode));
      put_last_sphere(file, i, slots[i]);
    }
    file.section(Kind::contents, 0, bytes.size());
    file.put(file.offset(Kind::contents), bytes.data(), bytes.size());
    return file.finish();
  }
  static Sphere last_sphere(std::uint32_t chunk) {
    return {{10 * static_cast<float>(chunk), 0, 0}, 1, 0};
  }
  static void put_last_sphere(SparseFile& file, std::uint32_t chunk, std::uint64_t slots) {
    std::vector<Sphere> spheres(1, last_sphere(chunk));
    Bvh tree = build_bvh(spheres, serial_for, {.depth = 1, .keeps_apart = false});
    tree.nodes[0].child[0] = static_cast<std::uint32_t>(leaf_bit | (slots / bvh_leaf_size - 1));
    tree.slots[0] = static_cast<std::int32_t>(slots - 3);
    file.put(file.offset(Kind::nodes, chunk), tree.nodes.data(), sizeof(BvhNode));
    file.put(file.offset(Kind::blocks, chunk) + (slots / bvh_leaf_size - 1) * sizeof(SphereBlock),
             tree.blocks.data(), sizeof(SphereBlock));
    file.put(file.offset(Kind::ids, chunk) + (slots - bvh_leaf_size) * sizeof(std::int32_t),
             tree.slots.data(), bvh_leaf_size * sizeof(std::int32_t));
  }
};

TEST_F(LargeFiles, RayFindsTheLastSlot) {
  if (!write_file({most_slots})) GTEST_SKIP() << "the file system has no files of this size";
  const auto file = PackedFile::open(path("large.boule"));
  ASSERT_TRUE(file) << file.error().message;
  auto scene = file.value().scene();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(count_primitives(scene.value()).spheres, 2147483646U);
  auto tracer = Tracer::create(std::move(scene).value(), {});
  ASSERT_TRUE(tracer) << tracer.error().message;
  const std::vector<Ray> rays(40, {{0, 0, 5}, {0, 0, -1}});
  std::vector<TracedHit> hits(rays.size());
  ASSERT_TRUE(tracer.value().closest(rays, hits));
  for (const TracedHit& hit : hits) {
    EXPECT_EQ(hit.t, 4);
    EXPECT_EQ(hit.id, 2147483645);
  }
}

/// 2 x 2^31 slots: opened and counted, and refused by name where they are to be rendered.
TEST_F(LargeFiles, OfSeveralChunksCountsBeyond32Bits) {
  if (!write_file({most_slots, most_slots}))
    GTEST_SKIP() << "the file system has no files of this size";
  const auto file = PackedFile::open(path("large.boule"));
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file.value().contents().spheres.count, 4294967292U);
  std::uint64_t slots = 0;
  for (const auto& section : file.value().sections()) {
    if (section.kind == Kind::ids) slots += section.bytes / sizeof(std::int32_t);
  }
  EXPECT_EQ(slots, std::uint64_t{1} << 32);
  const auto scene = file.value().scene();
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message,
            "has 4294967296 slots of spheres, at most 4294967295 can be rendered");
}

/// 3 x 10^9 slots: a ray finds the last one, under its id, on every instruction set.
TEST_F(LargeFiles, RayFindsTheLastOfBillions) {
  constexpr std::uint64_t rest = 3'000'000'000 - most_slots;
  if (!write_file({most_slots, rest})) GTEST_SKIP() << "the file system has no files of this size";
  const auto file = PackedFile::open(path("large.boule"));
  ASSERT_TRUE(file) << file.error().message;
  auto scene = file.value().scene();
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(count_primitives(scene.value()).spheres, 2'999'999'996U);
  scene.value().planes = {{{0, -1, 0}, {0, 1, 0}, 0}};
  const Geometry geometry = geometry_of(scene.value(), {}, serial_for);
  const std::vector<Ray> rays{
      {{0, 0, 5}, {0, 0, -1}}, {{10, 0, 5}, {0, 0, -1}}, {{20, 5, 0}, {0, -1, 0}}};
  for (const std::string& isa : all_isa_names()) {
    const KernelTable* const kernels = kernels_or_null(isa);
    if (kernels == nullptr) continue;
    const std::vector<Hit> hits = run_closest(*kernels, geometry.view(), rays, {});
    EXPECT_EQ(hits[0].t, 4) << isa;
    EXPECT_EQ(static_cast<std::uint32_t>(hits[0].id), most_slots - 3) << isa;
    EXPECT_EQ(hits[0].slot, most_slots - bvh_leaf_size) << isa;
    EXPECT_EQ(hits[1].t, 4) << isa;
    EXPECT_EQ(static_cast<std::uint32_t>(hits[1].id), most_slots - 2 + rest - 3) << isa;
    EXPECT_EQ(hits[1].slot, 3'000'000'000 - bvh_leaf_size) << isa;
    EXPECT_EQ(geometry.sphere(hits[1].slot).center.x, 10) << isa;
    EXPECT_EQ(static_cast<std::uint32_t>(hits[2].id), 2'999'999'996U) << isa;
    EXPECT_TRUE(geometry.is_plane(hits[2])) << isa;
  }
}

}  // namespace
}  // namespace boule::test
