#pragma once

#include <cstdint>
#include <vector>

namespace boule {

/// What rays cross, ray after ray: those of ray k are at offset[k] .. offset[k + 1] - 1, in order
/// of t; at equal t the lower id first, and of one primitive the entry.
struct Crossings {
  std::vector<std::int64_t> offset;  ///< one more than there are rays
  std::vector<double> t;
  std::vector<std::int32_t> id;
  std::vector<std::uint8_t> entering;  ///< 1 or 0, as TracedHit::entering
};

/// The lengths of rays inside spheres and capsules, in the order of ids; `offset` as in Crossings.
struct SphereChords {
  std::vector<std::int64_t> offset;
  std::vector<std::int32_t> id;
  std::vector<double> length;  ///< in units of t
};

/// Items of rays, in pieces; `offset` as in Crossings.
template <class Item>
struct RayLists {
  std::vector<std::int64_t> offset;
  std::vector<std::vector<Item>> pieces;  ///< behind one another
};

}  // namespace boule
