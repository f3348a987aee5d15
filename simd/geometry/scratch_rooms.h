#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "simd/geometry/build_box.h"

namespace boule {

/// Rooms for spheres that are being moved. Threads use the same ones again and again: pages that
/// are fresh from the system for every chunk take longer than the moving.
class ScratchRooms {
 public:
  /// Calls use(room), with room for `size` spheres that nobody else uses meanwhile. Threads may
  /// call it at the same time. Throws std::bad_alloc, and what `use` throws.
  void lend(std::size_t size, const auto& use) {
    Room room = take();
    if (room.size < size) {
      room = {};  // first, so that never both are there
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
