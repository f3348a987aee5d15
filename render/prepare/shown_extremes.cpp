#include "render/prepare/shown_extremes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/scene/capsule_ends.h"

namespace boule {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

/// A measure of a group's spheres where an instance shows them is this one of the spheres in the
/// group, but for direction . shift.
SphereMeasure in_group(const SphereMeasure& measure, const Similarity& t) {
  const Vec3d& d = measure.direction;
  const Vec3d turned = t.row_x * d.x + t.row_y * d.y + t.row_z * d.z;
  return {turned * t.scale, measure.weight * t.scale};
}

}  // namespace

/// Looks for the least of one measure.
class ShownExtremes::Search {
 public:
  Search(const ShownExtremes& all, const SphereMeasure& measure) : all_(all), measure_(measure) {}

  std::vector<Found> find() {
    std::vector<Reach> reaches = near_reaches();
    double best = inf;
    std::vector<std::pair<double, std::uint32_t>> met;  // in the order of `reaches`
    for (const auto& [least_in_box, shown] : reaches) {
      if (!(least_in_box <= best + all_.margin_)) break;
      met.emplace_back(inside(shown).least + shift_of(shown), shown);
      best = std::min(best, met.back().first);
    }
    std::vector<Found> found;
    for (const auto& [least, shown] : met) {
      if (least <= best + all_.margin_) found.push_back({shown, spheres_of(shown)});
    }
    return found;
  }

 private:
  using Reach = std::pair<double, std::uint32_t>;
  /// What is known about a group in one orientation and size.
  struct Inside {
    double least = inf;
    std::vector<std::uint32_t> spheres;  ///< within the margin of the least; empty: not looked for
  };
  using Orientation = std::array<double, 5>;

  /// How far the boxes around what is shown reach, least first, without those that certainly have
  /// no sphere for which the measure is least.
  std::vector<Reach> near_reaches() const {
    std::vector<Reach> reaches;
    double highest = inf;  // some sphere is not beyond this
    for (std::uint32_t i = 0; i < all_.shown_.size(); ++i) {
      const SphereMeasure own = in_group(measure_, all_.shown_[i].transform);
      const Box& box = all_.boxes_[all_.shown_[i].group];
      const double shift = shift_of(i);
      const double low = shift + own.least_in(box.low, box.high) - own.weight * box.largest_radius;
      const SphereMeasure opposite{own.direction * -1.0, 0};
      highest = std::min(highest, shift - opposite.least_in(box.low, box.high));
      if (low <= highest + all_.margin_) reaches.emplace_back(low, i);
    }
    std::erase_if(reaches, [&](const Reach& r) { return !(r.first <= highest + all_.margin_); });
    std::sort(reaches.begin(), reaches.end());
    return reaches;
  }

  [[nodiscard]] double shift_of(std::uint32_t shown) const {
    return dot(measure_.direction, all_.shown_[shown].transform.shift);
  }

  Inside& inside(std::uint32_t shown) {
    const ShownGroup& one = all_.shown_[shown];
    const SphereMeasure own = in_group(measure_, one.transform);
    const Vec3d& d = own.direction;
    const auto [at, is_new] =
        known_.try_emplace({static_cast<double>(one.group), d.x, d.y, d.z, own.weight});
    if (is_new) {
      for (const Sphere& sphere : all_.scene_.groups[one.group].spheres)
        at->second.least = std::min(at->second.least, own.of(sphere));
    }
    return at->second;
  }

  const std::vector<std::uint32_t>& spheres_of(std::uint32_t shown) {
    Inside& known = inside(shown);
    if (!known.spheres.empty()) return known.spheres;
    const ShownGroup& one = all_.shown_[shown];
    const SphereMeasure own = in_group(measure_, one.transform);
    const std::vector<Sphere>& spheres = all_.scene_.groups[one.group].spheres;
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
      if (own.of(spheres[i]) <= known.least + all_.margin_) known.spheres.push_back(i);
    }
    return known.spheres;
  }

  const ShownExtremes& all_;
  const SphereMeasure& measure_;
  std::map<Orientation, Inside> known_;
};

ShownExtremes::ShownExtremes(const Scene& scene, const ParallelFor& parallel_for)
    : scene_(scene), parallel_for_(parallel_for), boxes_(scene.groups.size()) {
  visit_shown_groups(scene, [this](const ShownGroup& shown) { shown_.push_back(shown); });
  parallel_for(boxes_.size(), [&](std::size_t i) { boxes_[i] = box_of(scene.groups[i].spheres); });
  double farthest = 0;
  for (const ShownGroup& one : shown_) {
    const Box& box = boxes_[one.group];
    const auto reach = [](double a, double b) { return std::max(std::fabs(a), std::fabs(b)); };
    const double size = reach(box.low.x, box.high.x) + reach(box.low.y, box.high.y) +
                        reach(box.low.z, box.high.z) + box.largest_radius;
    const Vec3d& shift = one.transform.shift;
    farthest = std::max(farthest, one.transform.scale * size + std::fabs(shift.x) +
                                      std::fabs(shift.y) + std::fabs(shift.z));
  }
  // Centres and radii are rounded to float, by 2^-24 of the farthest in each of four numbers, and
  // so are those of the sphere that they are compared with.
  margin_ = 0x1p-20 * farthest + 0x1p-140;
}

SphereRuns ShownExtremes::runs(std::vector<SphereMeasure> measures) const {
  return [this, measures = std::move(measures)](const std::function<void(SphereRun)>& function) {
    std::vector<std::vector<Found>> found(measures.size());
    parallel_for_(measures.size(), [&](std::size_t i) {
      found[i] =
          measures[i].direction == Vec3d{} ? largest_spheres() : Search(*this, measures[i]).find();
    });
    if (!scene_.spheres.empty()) function(scene_.spheres);
    for (const std::vector<Found>& of_one : found) visit(of_one, function);
    visit_end_spheres(scene_, function);
  };
}

ShownExtremes::Box ShownExtremes::box_of(std::span<const Sphere> spheres) const {
  Box box{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Vec3d c = vec_cast<double>(spheres[i].center);
    box.low = {std::min(box.low.x, c.x), std::min(box.low.y, c.y), std::min(box.low.z, c.z)};
    box.high = {std::max(box.high.x, c.x), std::max(box.high.y, c.y), std::max(box.high.z, c.z)};
    const auto radius = static_cast<double>(spheres[i].radius);
    if (radius > box.largest_radius) box.largest = i;
    box.largest_radius = std::max(box.largest_radius, radius);
  }
  return box;
}

/// A sphere with the largest radius. Radii keep their order when they are scaled and rounded.
std::vector<ShownExtremes::Found> ShownExtremes::largest_spheres() const {
  std::vector<Found> found;
  float radius = 0;
  for (std::uint32_t i = 0; i < shown_.size(); ++i) {
    const Box& box = boxes_[shown_[i].group];
    const auto own = static_cast<float>(shown_[i].transform.scale * box.largest_radius);
    if (!(own > radius)) continue;
    radius = own;
    found = {{i, {static_cast<std::uint32_t>(box.largest)}}};
  }
  return found;
}

void ShownExtremes::visit(const std::vector<Found>& found,
                          const std::function<void(SphereRun)>& function) const {
  constexpr std::size_t most_together = 4096;
  std::vector<Sphere> some;
  for (const Found& one : found) {
    const ShownGroup& shown = shown_[one.shown];
    for (const std::uint32_t i : one.spheres) {
      some.push_back(
          transformed(scene_.groups[shown.group].spheres[i], shown.transform, shown.material));
      if (some.size() < most_together) continue;
      function(some);
      some.clear();
    }
  }
  if (!some.empty()) function(some);
}

}  // namespace boule
