#include "render/files/packed/packed_file.h"

#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/base/text.h"
#include "core/scene/instances.h"
#include "render/files/file/input_file.h"
#include "render/files/packed/node_check.h"
#include "render/files/packed/piece_checksum.h"
#include "render/memory/available_memory.h"
#include "simd/geometry/bvh_builder.h"
#include "simd/geometry/parts.h"

namespace boule {

using packed_format::Header;
using packed_format::Kind;
using packed_format::page;

namespace {

template <class T>
LargeArray<T> view_of(std::string_view bytes) {
  return LargeArray<T>::borrowed(reinterpret_cast<const T*>(bytes.data()),
                                 bytes.size() / sizeof(T));
}

/// A tree and the file that it lies in.
struct MappedTree {
  std::shared_ptr<const void> map;
  Bvh tree;
};

}  // namespace

/// The bytes of a file.
class PackedFile::Map {
 public:
  Map(void* data, std::size_t size) : data_(data), size_(size) {}
  ~Map() { ::munmap(data_, size_); }
  Map(const Map&) = delete;
  Map& operator=(const Map&) = delete;

  [[nodiscard]] std::string_view bytes() const { return {static_cast<const char*>(data_), size_}; }

 private:
  void* data_;
  std::size_t size_;
};

bool is_packed_name(std::string_view path) {
  constexpr std::string_view ending = ".boule";
  if (path.size() < ending.size()) return false;
  path.remove_prefix(path.size() - ending.size());
  return std::equal(path.begin(), path.end(), ending.begin(),
                    [](char a, char b) { return ascii_lower(a) == b; });
}

Result<PackedFile> PackedFile::open(const std::string& path, const PackedOptions& options) {
  PackedFile file(path);
  if (auto done = file.map(); !done) return done.error();
  if (auto done = file.read_header(); !done) return done.error();
  if (auto done = file.read_contents(); !done) return done.error();
  for (std::uint32_t chunk = 0; chunk < file.contents_.chunks.size(); ++chunk) {
    if (auto done = file.read_chunk(chunk, options); !done) return done.error();
  }
  return file;
}

Diagnostic PackedFile::wrong(const std::string& what) const {
  return Diagnostic::in_file(path_, what);
}

Status PackedFile::map() {
  if (!packed_format::is_supported)
    return wrong("packed scenes are little-endian, and this computer is not");
  const auto file = InputFile::open(path_);
  if (!file) return file.error();
  const std::uint64_t size = file.value().size();
  if (size < page) return wrong("is no packed scene, or is cut off: it is too short");
  if (size > process_room().addresses)
    return wrong("cannot read it: it is larger than the limit on addresses");
  const auto length = static_cast<std::size_t>(size);
  void* const data = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, file.value().descriptor(), 0);
  if (data == MAP_FAILED) return wrong("cannot read it: " + std::generic_category().message(errno));
  map_ = std::make_shared<const Map>(data, length);
  return {};
}

Status PackedFile::read_header() {
  const std::string_view all = map_->bytes();
  Header header;
  std::memcpy(&header, all.data(), sizeof header);
  if (std::memcmp(header.magic, packed_format::magic, sizeof header.magic) != 0)
    return wrong("is no packed scene by its first bytes");
  if (header.version != packed_format::version) {
    return wrong("is a packed scene of version " + std::to_string(header.version) +
                 ", expected version " + std::to_string(packed_format::version));
  }
  if (header.file_bytes != all.size()) {
    return wrong("has " + std::to_string(all.size()) + " bytes in place of " +
                 std::to_string(header.file_bytes) + ": it is cut off or damaged");
  }
  const std::uint64_t checksum = std::exchange(header.checksum, 0);
  if (checksum != 0 && Checksum::available() &&
      PieceChecksum::of_piece({reinterpret_cast<const char*>(&header), sizeof header}) != checksum)
    return wrong("its header is damaged");
  if (header.sections > packed_format::most_sections) return wrong("its header is damaged");
  for (std::size_t i = 0; i < header.sections; ++i) {
    const Section& section = header.section[i];
    const bool lies_within = section.offset >= page && section.offset % page == 0 &&
                             section.offset <= all.size() &&
                             section.bytes <= all.size() - section.offset;
    if (!lies_within) return wrong("its header is damaged: a section lies outside of the file");
    sections_.push_back(section);
  }
  return {};
}

const packed_format::Section* PackedFile::find(Kind kind, std::uint32_t chunk) const {
  const auto found = std::find_if(sections_.begin(), sections_.end(), [&](const Section& section) {
    return section.kind == kind && section.chunk == chunk;
  });
  return found == sections_.end() ? nullptr : &*found;
}

std::string_view PackedFile::bytes_of(const Section& section) const {
  return map_->bytes().substr(static_cast<std::size_t>(section.offset),
                              static_cast<std::size_t>(section.bytes));
}

bool PackedFile::is_sound(const Section& section, const ParallelFor& parallel_for) const {
  if (section.checksum == 0 || !Checksum::available()) return true;
  return PieceChecksum::of_all(bytes_of(section), parallel_for) == section.checksum;
}

Status PackedFile::read_contents() {
  const Section* const section = find(Kind::contents, 0);
  if (section == nullptr) return wrong("its header is damaged: it has no contents");
  if (!is_sound(*section, serial_for)) return wrong("its contents are damaged");
  auto contents = decode(bytes_of(*section));
  if (!contents) {
    Diagnostic error = contents.error();
    error.file = path_;
    return error;
  }
  contents_ = std::move(contents).value();
  return {};
}

Status PackedFile::read_chunk(std::uint32_t chunk, const PackedOptions& options) {
  const PackedChunk& facts = contents_.chunks[chunk];
  const Section* const blocks = find(Kind::blocks, chunk);
  const Section* const ids = find(Kind::ids, chunk);
  const Section* const nodes = find(Kind::nodes, chunk);
  const Section* const materials = find(Kind::materials, chunk);
  if (blocks == nullptr || ids == nullptr || nodes == nullptr)
    return wrong("its header is damaged: it lacks a section");
  const std::uint64_t leaves_and_scanned = blocks->bytes / sizeof(SphereBlock);
  const std::uint64_t slots = leaves_and_scanned * bvh_leaf_size;
  const bool fits = blocks->bytes % sizeof(SphereBlock) == 0 &&
                    nodes->bytes % sizeof(BvhNode) == 0 && slots <= packed_format::most_slots &&
                    ids->bytes == slots * sizeof(std::int32_t) &&
                    (materials == nullptr || materials->bytes == slots * sizeof(MaterialRef)) &&
                    facts.scanned % bvh_leaf_size == 0 && facts.scanned <= slots &&
                    (nodes->bytes > 0 || facts.scanned == slots);
  if (!fits) return wrong("its sections do not fit together: it is damaged");
  if (!options.trust) {
    if (!is_sound(*nodes, options.parallel_for)) return wrong("its nodes are damaged");
    const std::string_view bytes = bytes_of(*nodes);
    const std::span all(reinterpret_cast<const BvhNode*>(bytes.data()),
                        bytes.size() / sizeof(BvhNode));
    const std::uint64_t leaves = leaves_and_scanned - facts.scanned / bvh_leaf_size;
    if (auto done = check_nodes(all, leaves, options.parallel_for); !done)
      return wrong(done.error().message);
  }
  auto mapped = std::make_shared<MappedTree>();
  mapped->map = map_;
  Bvh& tree = mapped->tree;
  tree.nodes = view_of<BvhNode>(bytes_of(*nodes));
  tree.slots = view_of<std::int32_t>(bytes_of(*ids));
  tree.scanned = static_cast<std::size_t>(facts.scanned);
  tree.blocks = view_of<SphereBlock>(bytes_of(*blocks));
  if (materials == nullptr) {
    tree.materials = SlotMaterials(facts.material);
  } else {
    const auto count = static_cast<std::uint32_t>(contents_.scene.materials.size());
    tree.materials =
        SlotMaterials(reinterpret_cast<const MaterialRef*>(bytes_of(*materials).data()), count);
  }
  trees_.push_back(std::shared_ptr<const Bvh>(mapped, &mapped->tree));
  return {};
}

/// What the parts of a geometry ask for.
Status PackedFile::check_parts() const {
  std::uint64_t slots = 0;
  for (const auto& tree : trees_) slots += tree->slots.size();
  if (slots > GeometryParts::most_slots) {
    return wrong("has " + std::to_string(slots) + " slots of spheres, at most " +
                 std::to_string(GeometryParts::most_slots) + " can be rendered");
  }
  for (const Sphere& s : contents_.spheres.extremes) {
    for (const float one : {s.center.x, s.center.y, s.center.z, s.radius}) {
      if (std::fabs(static_cast<double>(one)) < most_shared_coordinate) continue;
      return wrong("has chunks of spheres, of which some are farther away or larger than 1e17");
    }
  }
  return {};
}

Result<Scene> PackedFile::scene() const {
  Scene scene = contents_.scene;
  if (trees_.empty()) return scene;
  if (trees_.size() > 1) {
    if (auto done = check_parts(); !done) return done.error();
  }
  auto spheres = std::make_shared<PackedSpheres>(contents_.spheres);
  spheres->file = path_;
  for (std::size_t i = 0; i < trees_.size(); ++i)
    spheres->trees.push_back({trees_[i], contents_.chunks[i].spheres});
  scene.packed = std::move(spheres);
  return scene;
}

Status PackedFile::verify(const ParallelFor& parallel_for) const {
  if (!Checksum::available()) return wrong("this build of Boule has no checksums (xxHash)");
  for (const Section& section : sections_) {
    const std::string name = name_of(section.kind);
    if (section.checksum == 0) return wrong("was packed without checksums");
    if (!is_sound(section, parallel_for)) {
      return wrong(
          "its section " + name + " is damaged" +
          (contents_.chunks.size() > 1 ? " in chunk " + std::to_string(section.chunk) : ""));
    }
  }
  return {};
}

}  // namespace boule
