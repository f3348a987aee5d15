#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "simd/geometry/build_box.h"

namespace boule {

/// Buffers for spheres that are being moved. Threads reuse them, because fresh pages from the
/// system for every chunk take longer than the moving.
class ScratchRooms {
 public:
  /// Calls use(room), with room for `size` spheres that is used by this call alone. Threads may
  /// call it in parallel. Throws std::bad_alloc, and the exceptions of `use`.
  void lend(std::size_t size, const auto& use) {
    Room room = take();
    if (room.size < size) {
      room = {};  // first, so that only one of both exists at a time
      room = {std::make_unique_for_overwrite<BuildSphere[]>(size), size};
    }
    use(std::span<BuildSphere>(room.spheres.get(), size));
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(room));
  }

 private:
  struct Room {
    std::unique_ptr<BuildSphere[]> spheres;
    std::size_t size = 0;
  };

  Room take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return {};
    Room room = std::move(idle_.back());
    idle_.pop_back();
    return room;
  }

  std::mutex mutex_;
  std::vector<Room> idle_;
};

}  // namespace boule
