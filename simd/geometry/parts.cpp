#include "simd/geometry/parts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "simd/geometry/geometry.h"
#include "simd/geometry/part_boxes.h"
#include "simd/geometry/part_placement.h"

namespace boule {
namespace {

/// `slots` and `spheres`: the numbers in the parts before.
PartView view_of(const GeometryPart& part, std::uint64_t slots, std::size_t spheres) {
  const GeometryView tree = part.tree->view();
  const std::size_t scanned = tree.spheres.scanned;
  std::size_t filled = 0;
  while (filled < scanned && tree.spheres.id[filled] >= 0) ++filled;
  return {.placement = placement_of(part.transform),
          .nodes = tree.bvh.size == 0 ? nullptr : tree.bvh.nodes,
          .blocks = tree.spheres.blocks,
          .id = tree.spheres.id,
          .scanned = static_cast<std::uint32_t>(padded(scanned)),
          .scanned_spheres = static_cast<std::uint32_t>(filled),
          .slots = static_cast<std::uint32_t>(tree.spheres.block_count * bvh_leaf_size),
          .first_slot = static_cast<std::uint32_t>(slots),
          .first_id = static_cast<std::int32_t>(static_cast<std::uint32_t>(spheres))};
}

float extent_of(const BuildBox& box) {
  float extent = 0;
  for (int k = 0; k < 3; ++k)
    extent = std::max({extent, std::fabs(box.low[k]), std::fabs(box.high[k])});
  return extent;
}

}  // namespace

GeometryParts::GeometryParts(std::vector<GeometryPart> parts) : parts_(std::move(parts)) {
  std::uint64_t slots = 0;
  views_.reserve(parts_.size());
  std::vector<BuildBox> boxes;
  boxes.reserve(parts_.size());
  for (const GeometryPart& part : parts_) {
    views_.push_back(view_of(part, slots, spheres_));
    boxes.push_back(box_of(views_.back()));
    extent_ = std::max(extent_, extent_of(boxes.back()));
    slots += views_.back().slots;
    if (slots > most_slots)
      throw std::length_error("instances show more spheres than there are places for");
    spheres_ += part.tree->sphere_count();
  }
  nodes_ = build_box_tree(boxes);
}

std::size_t GeometryParts::part_of(std::uint32_t slot) const {
  const auto after =
      std::upper_bound(views_.begin(), views_.end(), slot,
                       [](std::uint32_t at, const PartView& part) { return at < part.first_slot; });
  return static_cast<std::size_t>(after - views_.begin()) - 1;
}

Sphere GeometryParts::sphere(std::uint32_t slot) const {
  const PartView& part = views_[part_of(slot)];
  Sphere sphere = sphere_of(part, slot - part.first_slot);
  sphere.material = material(slot);
  return sphere;
}

std::vector<SphereCopy> GeometryParts::copies() const {
  std::vector<SphereCopy> all;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const std::int32_t before = views_[i].first_id;
    for (const SphereCopy& copy : parts_[i].tree->copies())
      all.push_back({before + copy.first, before + copy.second, before + copy.id});
  }
  return all;
}

MaterialRef GeometryParts::material(std::uint32_t slot) const {
  const std::size_t index = part_of(slot);
  const GeometryPart& part = parts_[index];
  if (part.material) return {*part.material};
  return part.tree->material(slot - views_[index].first_slot);
}

}  // namespace boule
