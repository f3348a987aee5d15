#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/scene/primitive.h"

namespace boule {

/// Where the spheres come from that are packed: in the order of their ids, twice.
class SphereSource {
 public:
  SphereSource() = default;
  virtual ~SphereSource() = default;
  SphereSource(const SphereSource&) = delete;
  SphereSource& operator=(const SphereSource&) = delete;

  /// Goes to the sphere with this number. Precondition: it was read before, or is the next one.
  virtual Status seek(std::uint64_t sphere) = 0;
  /// Replaces `part` by the next spheres, up to `most`; by none at the end. They are valid.
  virtual Status read(std::vector<Sphere>& part, std::size_t most) = 0;
  /// The spheres before this one will not be read any more.
  virtual void forget(std::uint64_t before) = 0;
};

/// Spheres in memory.
class SpheresInMemory final : public SphereSource {
 public:
  explicit SpheresInMemory(std::vector<Sphere> spheres) : spheres_(std::move(spheres)) {}

  Status seek(std::uint64_t sphere) override {
    next_ = static_cast<std::size_t>(sphere);
    return {};
  }
  Status read(std::vector<Sphere>& part, std::size_t most) override {
    const std::size_t size = std::min(most, spheres_.size() - next_);
    const auto first = spheres_.begin() + static_cast<std::ptrdiff_t>(next_);
    part.assign(first, first + static_cast<std::ptrdiff_t>(size));
    next_ += size;
    return {};
  }
  void forget(std::uint64_t) override {}

 private:
  std::vector<Sphere> spheres_;
  std::size_t next_ = 0;
};

}  // namespace boule
