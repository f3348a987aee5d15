#include "render/files/packed/pack.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/float_environment.h"
#include "render/files/packed/packed_contents.h"
#include "render/files/packed/packed_format.h"
#include "render/files/packed/sphere_survey.h"
#include "simd/geometry/spheres_apart.h"

namespace boule {
namespace {

constexpr std::size_t spheres_at_once = std::size_t{1} << 20;

/// Packs the chunks of one scene.
class Packer {
 public:
  Packer(PackRequest& request, PackWriter& writer)
      : source_(request.spheres),
        means_(request.means),
        writer_(writer),
        survey_(request.scene),
        most_(std::max<std::uint64_t>(spheres_in_memory(means_.memory), 1)) {}

  /// Packs the next chunk; true if there may be another.
  Result<bool> pack_chunk();

  [[nodiscard]] PackedSpheres facts() const { return survey_.facts(); }
  [[nodiscard]] std::vector<PackedChunk> chunks() const { return chunks_; }

 private:
  template <class Take>
  Status each_part(std::uint64_t count, const Take& take);
  Status distribute(const Partition& partition, BucketStore& store);
  Status add_apart();

  SphereSource& source_;
  const PackMeans& means_;
  PackWriter& writer_;
  SphereSurvey survey_;
  std::uint64_t most_;       ///< spheres in memory
  std::uint64_t first_ = 0;  ///< of the chunk
  std::vector<std::uint32_t> apart_;
  std::vector<Sphere> apart_spheres_;
  std::vector<PackedChunk> chunks_;
};

/// Calls take(part) for the chunk's spheres, `count` at most, part by part.
template <class Take>
Status Packer::each_part(std::uint64_t count, const Take& take) {
  if (auto done = source_.seek(first_); !done) return done;
  std::vector<Sphere> part;
  while (count > 0) {
    if (means_.stop && means_.stop()) return Diagnostic::of("interrupted");
    const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(count, spheres_at_once));
    if (auto done = source_.read(part, most); !done) return done;
    if (part.empty()) break;
    if (auto done = take(part); !done) return done;
    count -= part.size();
  }
  return {};
}

Result<bool> Packer::pack_chunk() {
  survey_.begin_chunk();
  const auto look = [&](const std::vector<Sphere>& part) -> Status {
    survey_.add(part, means_.parallel_for);
    return {};
  };
  if (auto done = each_part(means_.chunk, look); !done) return done.error();
  const std::uint64_t count = survey_.size();
  if (count == 0) return false;
  apart_ = survey_.apart();
  apart_spheres_.clear();
  const Partition partition(survey_.sample(), most_);
  BucketStore store(partition.buckets(), means_.memory / 2, means_.beside);
  if (auto done = distribute(partition, store); !done) return done.error();
  if (auto done = store.settle(); !done) return done.error();
  if (auto done = writer_.begin_chunk(survey_.alike()); !done) return done.error();
  if (auto done = add_apart(); !done) return done.error();
  PackTree tree(writer_, means_);
  if (auto done = tree.add(partition, store); !done) return done.error();
  if (auto done = writer_.end_chunk(); !done) return done.error();
  first_ += count;
  return count == means_.chunk;
}

/// Reads the spheres of the chunk once more, and puts them where they belong.
Status Packer::distribute(const Partition& partition, BucketStore& store) {
  std::uint32_t id = 0;
  auto next = apart_.begin();
  std::vector<std::uint16_t> buckets;
  constexpr std::size_t piece = 16'384;
  const auto put = [&](const std::vector<Sphere>& part) -> Status {
    buckets.resize(part.size());
    means_.parallel_for((part.size() + piece - 1) / piece, [&](std::size_t i) {
      const std::size_t end = std::min((i + 1) * piece, part.size());
      for (std::size_t k = i * piece; k < end; ++k) buckets[k] = partition.bucket_of(part[k]);
    });
    for (std::size_t k = 0; k < part.size(); ++k, ++id) {
      if (next != apart_.end() && *next == id) {
        apart_spheres_.push_back(part[k]);
        ++next;
      } else if (auto done = store.add(buckets[k], {part[k], id}); !done) {
        return done;
      }
    }
    source_.forget(first_ + id);
    return {};
  };
  return each_part(survey_.size(), put);
}

/// Appends the spheres that are in no leaf.
Status Packer::add_apart() {
  std::vector<std::int32_t> all(apart_.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> ids;
  std::vector<SphereCopy> copies;  // which a packed scene has no place for
  for (const std::int32_t i : without_copies(all, apart_spheres_, copies)) {
    spheres.push_back(apart_spheres_[static_cast<std::size_t>(i)]);
    ids.push_back(apart_[static_cast<std::size_t>(i)]);
  }
  const Bvh tree = no_bvh(spheres);
  chunks_.push_back(
      {.spheres = survey_.size(), .scanned = tree.slots.size(), .material = survey_.material()});
  const auto node = writer_.append(tree, ids);
  return node ? Status() : node.error();
}

}  // namespace

Result<PackResult> pack(PackRequest request) {
  const FloatEnvironment environment;
  if (!packed_format::is_supported)
    return Diagnostic::of("packed scenes are little-endian, and this computer is not");
  PackMeans& means = request.means;
  means.beside = request.output;
  auto writer = PackWriter::create(request.output, means.stop);
  if (!writer) return writer.error();
  Packer packer(request, writer.value());
  for (bool more = true; more;) {
    const auto packed = packer.pack_chunk();
    if (!packed) return packed.error();
    more = packed.value();
  }
  PackedContents contents;
  contents.scene = std::move(request.scene);
  contents.spheres = packer.facts();
  contents.chunks = packer.chunks();
  contents.origin = request.origin;
  const auto bytes = writer.value().finish(contents, means.stop);
  if (!bytes) return bytes.error();
  return PackResult{contents.spheres.count, bytes.value(), contents.chunks.size()};
}

}  // namespace boule
