#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/scene/primitive.h"
#include "simd/abi/bvh.h"

/// What a packed scene is on disk: a page with the header, then sections that begin at whole pages
/// and hold what stands in memory when a scene is rendered, so that it is mapped and not read.
/// Numbers are little-endian. docs/packed.md is the manual.
namespace boule::packed_format {

inline constexpr std::size_t page = 4096;
inline constexpr unsigned char magic[8] = {0x89, 'B', 'O', 'U', 'L', 'E', '\r', '\n'};
inline constexpr std::uint32_t version = 1;

/// What a section holds. Slots are counted within their chunk.
enum class Kind : std::uint32_t {
  contents = 1,   ///< all but the large arrays: PackedContents
  blocks = 2,     ///< SphereBlock: sixteen slots each, those of no leaf first
  ids = 3,        ///< std::int32_t a slot: the sphere's id, less the first of its chunk
  materials = 4,  ///< MaterialRef a slot; not there if all spheres are made of the same
  nodes = 5,      ///< BvhNode, the root first
};

constexpr const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::contents:
      return "contents";
    case Kind::blocks:
      return "blocks";
    case Kind::ids:
      return "ids";
    case Kind::materials:
      return "materials";
    case Kind::nodes:
      return "nodes";
  }
  return "unknown";
}

/// Where a section lies.
struct Section {
  Kind kind;
  std::uint32_t chunk;
  std::uint64_t offset, bytes;
  std::uint64_t checksum;  ///< PieceChecksum; 0: unknown
};

inline constexpr std::size_t most_sections = 126;

/// The first page.
struct Header {
  unsigned char magic[8];
  std::uint32_t version;
  std::uint32_t sections;
  std::uint64_t file_bytes;
  std::uint64_t checksum;  ///< of this page with 0 here; 0: unknown
  Section section[most_sections];
  unsigned char unused[page - 32 - most_sections * 32];
};
static_assert(sizeof(Section) == 32 && sizeof(Header) == page);

/// A chunk has at most so many slots, and so many spheres: their ids are 31 bits.
inline constexpr std::uint64_t most_slots = std::uint64_t{1} << 31;
inline constexpr std::uint64_t most_spheres = most_slots - 1;
/// One that is packed has at most so many spheres: leaves are not always full.
inline constexpr std::uint64_t packed_spheres = std::uint64_t{3} << 29;

/// The first byte behind `bytes` at which a page begins.
constexpr std::uint64_t next_page(std::uint64_t bytes) { return (bytes + page - 1) / page * page; }

/// Files are mapped as they are: other machines neither write nor read them.
inline constexpr bool is_supported = std::endian::native == std::endian::little;

static_assert(sizeof(SphereBlock) == 256 && sizeof(BvhNode) == 512 && sizeof(Sphere) == 20);

}  // namespace boule::packed_format
