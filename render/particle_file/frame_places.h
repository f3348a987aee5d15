#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/memory/available_memory.h"

namespace boule {

/// Appends the place of a frame to the list of a trajectory. An error if a longer list does not
/// fit into memory: a file of tiny frames makes it longer than the file.
template <class Place>
Status add_frame_place(std::vector<Place>& frames, const Place& place) {
  if (frames.size() == frames.capacity()) {
    const std::uint64_t bytes = std::uint64_t{2} * sizeof(Place) * (frames.size() + 1);
    const std::string who = "the list of its " + std::to_string(frames.size()) + " and more frames";
    if (auto no_room = check_memory(bytes, who + " needs")) return no_room;
  }
  frames.push_back(place);
  return std::nullopt;
}

}  // namespace boule
