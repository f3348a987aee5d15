// No packed file does harm: whatever its bytes are, it is refused or has a picture.
#include <cstring>

#include "render/files/packed/node_check.h"
#include "render/renderer/tracer.h"
#include "simd/geometry/bvh_builder.h"
#include "tests/render/files/packed/packed_scenes.h"

namespace boule::test {
namespace {

using packed_format::Header;
using packed_format::Kind;
using packed_format::page;

bool is_refusal(const std::string& found) { return !found.empty() && found != "other"; }

class DamagedFiles : public PackedTest {
 protected:
  void SetUp() override {
    Scene scene = cloud(400);
    scene.image = {8, 6, 1};
    ASSERT_GT(pack_to(path("scene.boule"), scene, 6400), 0U);  // 100 spheres at a time: two levels
    bytes_ = read_bytes(path("scene.boule"));
    picture_ = render(scene);
    std::memcpy(&header_, bytes_.data(), sizeof header_);
  }

  /// Opens a file of these bytes and renders it. The message of the refusal, or "" where the
  /// picture is the right one, or "other".
  std::string open(const std::string& bytes) const {
    write_bytes(path("changed.boule"), bytes);
    const auto file = PackedFile::open(path("changed.boule"));
    if (!file) {
      EXPECT_EQ(file.error().file, path("changed.boule"));
      return file.error().message;
    }
    const auto scene = file.value().scene();
    if (!scene) return scene.error().message;
    auto renderer = Renderer::create(scene.value(), options_of(scene.value()));
    if (!renderer) return renderer.error().message;
    const auto image = renderer.value().render();
    if (!image) return image.error().message;
    return differing_pixels(image.value(), picture_) == 0 ? "" : "other";
  }
  /// The file without checksums, as whoever wants to do harm would write it.
  std::string unsealed() const {
    Header header = header_;
    header.checksum = 0;
    for (auto& section : header.section) section.checksum = 0;
    std::string bytes = bytes_;
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
  }
  const packed_format::Section& section(Kind kind) const {
    for (std::size_t i = 0; i < header_.sections; ++i) {
      if (header_.section[i].kind == kind) return header_.section[i];
    }
    throw std::runtime_error("no such section");
  }
  static std::string with_change(std::string bytes, std::size_t at, int change) {
    bytes[at] = static_cast<char>(bytes[at] ^ change);
    return bytes;
  }

  std::string bytes_;
  Header header_{};
  Image picture_;
};

TEST_F(DamagedFiles, AsItIsItHasThePicture) {
  EXPECT_EQ(open(bytes_), "");
  EXPECT_EQ(open(unsealed()), "");
}

TEST_F(DamagedFiles, ChangedHeaderBytesAreRefusedOrUnused) {
  if (!Checksum::available()) GTEST_SKIP() << "this build has no checksums";
  for (std::size_t at = 0; at < page; at += at < 512 ? 1 : 37) {
    const std::string found = open(with_change(bytes_, at, 1 + static_cast<int>(at % 255)));
    EXPECT_NE(found, "") << at;
    EXPECT_NE(found, "other") << at;
  }
}

TEST_F(DamagedFiles, ChangedNodeBytesAreRefused) {
  if (!Checksum::available()) GTEST_SKIP() << "this build has no checksums";
  const auto& nodes = section(Kind::nodes);
  for (std::size_t i = 0; i < nodes.bytes; i += 3) {
    const std::string found = open(with_change(bytes_, nodes.offset + i, 1 << i % 8));
    EXPECT_EQ(found, "its nodes are damaged") << i;
  }
}

/// Without checksums nobody notices a box that is a little wrong: but nothing is read that is not
/// there, and nothing runs for ever.
TEST_F(DamagedFiles, WithoutChecksumsNoChangeDoesHarm) {
  const std::string bytes = unsealed();
  std::size_t refused = 0;
  for (std::size_t at = 0; at < 32 + 32 * header_.sections; ++at) {
    for (const int change : {0x01, 0x80})
      refused += is_refusal(open(with_change(bytes, at, change))) ? 1 : 0;
  }
  const auto& nodes = section(Kind::nodes);
  for (std::size_t i = 0; i < nodes.bytes; i += 13)
    open(with_change(bytes, nodes.offset + i, 1 << i % 8));
  for (const Kind kind : {Kind::ids, Kind::materials, Kind::blocks}) {
    const auto& all = section(kind);
    for (std::size_t i = 3; i < all.bytes; i += 4 * 61)  // the highest bytes of numbers
      open(with_change(bytes, all.offset + i, 0x7f));
  }
  EXPECT_GT(refused, 100U);
}

/// All ids, materials and spheres are what no program writes.
TEST_F(DamagedFiles, SlotsMayHoldAnything) {
  for (const int fill : {0x00, 0x7f, 0x80, 0xff}) {
    for (const Kind kind : {Kind::ids, Kind::materials, Kind::blocks}) {
      std::string bytes = unsealed();
      const auto& all = section(kind);
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(all.offset), all.bytes,
                  static_cast<char>(fill));
      const std::string found = open(bytes);
      EXPECT_TRUE(found.empty() || found == "other") << found;
    }
  }
}

TEST_F(DamagedFiles, CutAnywhereItIsRefused) {
  const std::size_t step = bytes_.size() > 200'000 ? 1009 : 211;
  for (std::size_t size = 0; size < bytes_.size(); size += size < 200 ? 1 : step)
    EXPECT_TRUE(is_refusal(open(bytes_.substr(0, size)))) << size;
  EXPECT_TRUE(is_refusal(open(bytes_.substr(0, bytes_.size() - 1))));
  EXPECT_TRUE(is_refusal(open(bytes_ + "x")));
}

TEST_F(DamagedFiles, OtherFilesAreToldApart) {
  EXPECT_EQ(open(""), "is no packed scene, or is cut off: it is too short");
  EXPECT_EQ(open(std::string(9000, 'x')), "is no packed scene by its first bytes");
  EXPECT_EQ(open(with_change(bytes_, 8, 3)), "is a packed scene of version 2, expected version 1");
  EXPECT_EQ(open(bytes_.substr(0, bytes_.size() - 10)),
            "has " + std::to_string(bytes_.size() - 10) + " bytes in place of " +
                std::to_string(bytes_.size()) + ": it is cut off or damaged");
}

/// A root with two children: a leaf and a node with a leaf.
std::vector<BvhNode> two_nodes() {
  BvhNode node{};
  for (std::size_t k = 0; k < bvh_width; ++k) {
    node.min_x[k] = node.min_y[k] = node.min_z[k] = std::numeric_limits<float>::infinity();
    node.max_x[k] = node.max_y[k] = node.max_z[k] = -std::numeric_limits<float>::infinity();
  }
  const auto add = [](BvhNode& to, std::uint32_t child, std::uint8_t size) {
    const std::size_t k = to.size++;
    to.min_x[k] = to.min_y[k] = to.min_z[k] = 0;
    to.max_x[k] = to.max_y[k] = to.max_z[k] = 1;
    to.child[k] = child;
    to.leaf_size[k] = size;
  };
  std::vector<BvhNode> nodes{node, node};
  add(nodes[0], leaf_bit | 1, 16);
  add(nodes[0], 1, 0);
  add(nodes[1], leaf_bit | 0, 3);
  return nodes;
}

TEST(NodeCheck, NamesWhatIsWrong) {
  EXPECT_TRUE(check_nodes(two_nodes(), 2, serial_for));
  EXPECT_TRUE(check_nodes({}, 0, serial_for));
  const auto problem = [](std::uint64_t leaves, const auto& change) {
    std::vector<BvhNode> nodes = two_nodes();
    change(nodes);
    const Status done = check_nodes(nodes, leaves, serial_for);
    return done ? "" : done.error().message;
  };
  const auto none = [](auto&) {};
  EXPECT_EQ(problem(1, none), "it is damaged: node 0 leads to a leaf that is not there");
  EXPECT_EQ(problem(2, [](auto& n) { n[0].size = 17; }),
            "it is damaged: node 0 has too many children");
  EXPECT_EQ(problem(2, [](auto& n) { n[0].leaf_size[0] = 17; }),
            "it is damaged: node 0 has a leaf of a wrong size");
  EXPECT_EQ(problem(2, [](auto& n) { n[1].leaf_size[0] = 0; }),
            "it is damaged: node 1 has a leaf of a wrong size");
  EXPECT_EQ(problem(2, [](auto& n) { n[0].leaf_size[1] = 1; }),
            "it is damaged: node 0 has a node with the size of a leaf");
  EXPECT_EQ(problem(2, [](auto& n) { n[0].child[1] = 0; }),
            "it is damaged: node 0 leads to a node that is not behind it");
  EXPECT_EQ(problem(2, [](auto& n) { n[0].child[1] = 2; }),
            "it is damaged: node 0 leads to a node that is not behind it");
  EXPECT_EQ(problem(2,
                    [](auto& n) {
                      n[0].child[0] = 1;
                      n[0].leaf_size[0] = 0;
                    }),
            "it is damaged: node 0 leads to a node that has another parent");
  EXPECT_EQ(problem(2, [](auto& n) { n[1].max_y[0] = std::numeric_limits<float>::quiet_NaN(); }),
            "it is damaged: node 1 has a box that is none");
  EXPECT_EQ(problem(2,
                    [](auto& n) {
                      n[1].min_x[15] = -1e30F;
                      n[1].max_x[15] = 1;
                    }),
            "it is damaged: node 1 has a box that is none");
}

TEST(NodeCheck, RefusesWhatLiesTooDeep) {
  const auto chain = [](int depth) {
    std::vector<BvhNode> nodes;
    for (int i = 0; i < depth; ++i) {
      nodes.push_back(two_nodes()[1]);
      if (i + 1 == depth) break;
      nodes.back().child[0] = static_cast<std::uint32_t>(i + 1);
      nodes.back().leaf_size[0] = 0;
    }
    return check_nodes(nodes, 1, serial_for);
  };
  EXPECT_TRUE(chain(bvh_max_depth));
  const Status done = chain(bvh_max_depth + 1);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "it is damaged: node 48 lies too deep");
}

}  // namespace
}  // namespace boule::test
