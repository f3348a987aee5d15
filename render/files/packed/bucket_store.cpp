#include "render/files/packed/bucket_store.h"

#include <algorithm>
#include <utility>

namespace boule {

static_assert(sizeof(PackedSphere) == 24);

BucketStore::BucketStore(std::size_t buckets, std::uint64_t memory, std::string beside)
    : buckets_(buckets),
      most_(static_cast<std::size_t>(
          std::max<std::uint64_t>(memory / sizeof(PackedSphere) / buckets, 1024))),
      beside_(std::move(beside)) {}

Status BucketStore::add(std::uint16_t bucket, const PackedSphere& sphere) {
  Bucket& own = buckets_[bucket];
  own.buffer.push_back(sphere);
  ++own.count;
  return own.buffer.size() < most_ ? Status() : spill(own);
}

Status BucketStore::spill(Bucket& bucket) {
  if (!file_) {
    auto file = SpillFile::create(beside_);
    if (!file) return file.error();
    file_.emplace(std::move(file).value());
  }
  bucket.extents.push_back({file_->size(), bucket.buffer.size()});
  if (auto done = file_->append(bucket.buffer.data(), bucket.buffer.size() * sizeof(PackedSphere));
      !done)
    return done;
  bucket.buffer.clear();
  return {};
}

Status BucketStore::settle() {
  if (buckets_.size() == 1) return {};
  for (Bucket& bucket : buckets_) {
    // Nothing is spilled where all of them fit.
    if (file_ && !bucket.buffer.empty()) {
      if (auto done = spill(bucket); !done) return done;
      std::vector<PackedSphere>().swap(bucket.buffer);
    }
  }
  return {};
}

Status BucketStore::drain(std::size_t index,
                          const std::function<Status(std::span<const PackedSphere>)>& take) {
  Bucket& bucket = buckets_[index];
  constexpr std::size_t at_once = std::size_t{1} << 18;
  std::vector<PackedSphere> some;
  for (const Extent& extent : bucket.extents) {
    for (std::size_t done = 0; done < extent.count; done += some.size()) {
      some.resize(std::min(at_once, extent.count - done));
      const std::uint64_t at = extent.offset + done * sizeof(PackedSphere);
      if (auto read = file_->read(at, some.data(), some.size() * sizeof(PackedSphere)); !read)
        return read;
      if (auto taken = take(some); !taken) return taken;
    }
    file_->forget(extent.offset, extent.count * sizeof(PackedSphere));
  }
  if (auto done = take(bucket.buffer); !done) return done;
  bucket = {};
  return {};
}

}  // namespace boule
