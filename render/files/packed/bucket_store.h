#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/files/packed/sphere_survey.h"
#include "render/files/packed/spill_file.h"

namespace boule {

/// Spheres in buckets, each of which keeps its order: in memory as long as they fit, else in a
/// file.
class BucketStore {
 public:
  /// `memory`: bytes that they may take in memory. `beside`: SpillFile::create().
  BucketStore(std::size_t buckets, std::uint64_t memory, std::string beside);

  Status add(std::uint16_t bucket, const PackedSphere& sphere);
  /// Gives back memory: those of more than one bucket go to the file.
  Status settle();

  [[nodiscard]] std::size_t size() const { return buckets_.size(); }
  [[nodiscard]] std::uint64_t count(std::size_t bucket) const { return buckets_[bucket].count; }

  /// Calls take(some) with the spheres of a bucket in order, and forgets them.
  Status drain(std::size_t bucket,
               const std::function<Status(std::span<const PackedSphere> some)>& take);

 private:
  struct Extent {
    std::uint64_t offset;
    std::size_t count;
  };
  struct Bucket {
    std::vector<PackedSphere> buffer;
    std::vector<Extent> extents;  ///< in the file, before those in the buffer
    std::uint64_t count = 0;
  };

  Status spill(Bucket& bucket);

  std::vector<Bucket> buckets_;
  std::size_t most_;  ///< of a buffer
  std::string beside_;
  std::optional<SpillFile> file_;
};

}  // namespace boule
