#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/field.h"

namespace boule {

/// Which spheres and capsules of a scene an outline goes around together, by their place among the
/// scene's own. Those of one group, from 1, have lines between them only where the depth jumps;
/// those of 0, and those behind the end of a list, are by themselves.
struct OutlineGroups {
  std::vector<std::uint32_t> spheres{}, capsules{};
  std::uint32_t largest = 0;  ///< 0: there are no groups

  [[nodiscard]] bool empty() const { return largest == 0; }

  /// The group at a place of one of the lists.
  static std::uint32_t at(const std::vector<std::uint32_t>& groups, std::size_t place) {
    return place < groups.size() ? groups[place] : 0;
  }
};

template <>
inline constexpr auto fields<OutlineGroups> = field_list(
    "outline_groups", field("spheres", &OutlineGroups::spheres),
    field("capsules", &OutlineGroups::capsules), field("largest", &OutlineGroups::largest));

}  // namespace boule
