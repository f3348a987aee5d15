#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/packed/bucket_store.h"
#include "render/files/packed/pack_writer.h"
#include "render/files/packed/packed_format.h"
#include "render/files/packed/partition.h"
#include "simd/geometry/build_box.h"

namespace boule {

/// What packing may use.
struct PackMeans {
  std::uint64_t memory = 0;  ///< bytes, about
  std::string beside;        ///< where temporary files go: SpillFile::create()
  ParallelFor parallel_for = serial_for;
  /// The most spheres of a chunk.
  std::uint64_t chunk = packed_format::packed_spheres;
  std::function<bool()> stop{};  ///< asked now and then; true ends it with "interrupted"
};

/// The spheres that are built at a time.
constexpr std::uint64_t spheres_in_memory(std::uint64_t memory) {
  constexpr std::uint64_t each = 64;  // bytes: the tree while it is built, and what becomes it
  return memory / each;
}

/// Builds a tree larger than the memory, and writes it: bucket by bucket as build_bvh() does, and
/// the nodes above them. A bucket that is too large is divided again.
class PackTree {
 public:
  PackTree(PackWriter& writer, const PackMeans& means) : writer_(writer), means_(means) {}

  /// Appends the tree over spheres that were divided so, if there are any.
  Status add(const Partition& partition, BucketStore& store);

 private:
  /// A part of the tree that is written.
  struct Part {
    BuildBox box;
    std::uint32_t node = 0;
  };
  /// The cuts that become nodes, and how many spheres lie below each cut.
  struct Plan {
    const Partition& partition;
    BucketStore& store;
    std::vector<std::uint64_t> counts{};
    std::uint32_t next_node = 0;
  };

  Result<Part> add(const Partition& partition, BucketStore& store, int depth);
  Result<Part> add_node(Plan& plan, std::uint32_t cut, int depth);
  Result<Part> add_bucket(BucketStore& store, std::size_t bucket, int depth);
  Result<Part> divide(BucketStore& store, std::size_t bucket, int depth);
  Result<Part> add_without_copies(BucketStore& store, std::size_t bucket, const Sphere& sphere,
                                  int depth);
  Result<Part> build(BucketStore& store, std::size_t bucket, int depth);

  PackWriter& writer_;
  const PackMeans& means_;
};

}  // namespace boule
