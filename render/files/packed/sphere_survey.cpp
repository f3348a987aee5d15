#include "render/files/packed/sphere_survey.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "simd/geometry/tuning.h"

namespace boule {
namespace {

constexpr std::size_t piece_size = 16'384;
constexpr std::size_t most_first = 16;  ///< spheres that are kept to be shown

/// Larger ones first; of equal ones the lower id.
bool is_larger(const PackedSphere& a, const PackedSphere& b) {
  if (a.sphere.radius != b.sphere.radius) return a.sphere.radius > b.sphere.radius;
  return a.id < b.id;
}

BuildBox rough_box(const Sphere& s) {
  return boule::rough_box(Float4{s.center.x, s.center.y, s.center.z, s.radius});
}

/// Enters a sphere among the largest. Returns the one that there is no room for.
std::optional<PackedSphere> enter(std::vector<PackedSphere>& large, const PackedSphere& sphere) {
  if (large.size() < tuning::most_giants) {
    large.push_back(sphere);
    std::push_heap(large.begin(), large.end(), is_larger);
    return std::nullopt;
  }
  if (!is_larger(sphere, large.front())) return sphere;
  std::pop_heap(large.begin(), large.end(), is_larger);
  const PackedSphere out = std::exchange(large.back(), sphere);
  std::push_heap(large.begin(), large.end(), is_larger);
  return out;
}

bool gives_light(const NamedMaterial& named) {
  return std::holds_alternative<Emissive>(named.material);
}

}  // namespace

void SphereSample::take(const Sphere& sphere) {
  constexpr std::size_t most = std::size_t{1} << 17;
  if (spheres_.size() == most) {
    for (std::size_t i = 0; i < most / 2; ++i) spheres_[i] = spheres_[2 * i];
    spheres_.resize(most / 2);
    step_ *= 2;  // this sphere's number is a multiple of it, because `most` is even
  }
  spheres_.push_back(sphere);
}

/// What one thread finds.
struct SphereSurvey::Piece {
  Vec3d low{inf, inf, inf}, high{-inf, -inf, -inf};
  bool has_own_colors = false, alike = true;
  std::vector<std::uint32_t> made_of;
  std::vector<Sphere> emissive;
  AxisExtremes extremes;
  std::vector<std::uint32_t> unfit;
  std::vector<PackedSphere> large;
  BuildBox rest;
};

void SphereSurvey::begin_chunk() {
  alike_ = true;
  material_ = {};
  sample_ = {};
  unfit_.clear();
  large_.clear();
  rest_ = {};
}

void SphereSurvey::survey(std::span<const Sphere> spheres, std::uint32_t first,
                          Piece& piece) const {
  piece.made_of.resize(made_of_.size());
  std::uint32_t id = first;
  for (const Sphere& s : spheres) {
    const Vec3d c = vec_cast<double>(s.center);
    const auto r = static_cast<double>(s.radius);
    Vec3d &low = piece.low, &high = piece.high;
    low = {std::min(low.x, c.x - r), std::min(low.y, c.y - r), std::min(low.z, c.z - r)};
    high = {std::max(high.x, c.x + r), std::max(high.y, c.y + r), std::max(high.z, c.z + r)};
    piece.extremes.add(s);
    piece.has_own_colors |= s.material.has_color();
    piece.alike &= s.material == material_;
    ++piece.made_of[s.material.index()];
    if (gives_light(scene_.materials[s.material.index()])) piece.emissive.push_back(s);
    if (!in_filter_range(s)) {
      piece.unfit.push_back(id++);
    } else if (const auto out = enter(piece.large, {s, id++})) {
      piece.rest.add(rough_box(out->sphere));
    }
  }
}

void SphereSurvey::add(const Piece& piece) {
  const Vec3d &low = piece.low, &high = piece.high;
  low_ = {std::min(low_.x, low.x), std::min(low_.y, low.y), std::min(low_.z, low.z)};
  high_ = {std::max(high_.x, high.x), std::max(high_.y, high.y), std::max(high_.z, high.z)};
  extremes_.add(piece.extremes);
  has_own_colors_ |= piece.has_own_colors;
  alike_ &= piece.alike;
  for (std::size_t i = 0; i < made_of_.size(); ++i) made_of_[i] += piece.made_of[i];
  emissive_.insert(emissive_.end(), piece.emissive.begin(), piece.emissive.end());
  unfit_.insert(unfit_.end(), piece.unfit.begin(), piece.unfit.end());
  rest_.add(piece.rest);
  for (const PackedSphere& sphere : piece.large) {
    if (const auto out = enter(large_, sphere)) rest_.add(rough_box(out->sphere));
  }
}

void SphereSurvey::add(std::span<const Sphere> spheres, const ParallelFor& parallel_for) {
  if (spheres.empty()) return;
  digest_.add(spheres, parallel_for);
  if (sample_.count() == 0) material_ = spheres.front().material;
  const auto first = static_cast<std::uint32_t>(sample_.count());
  std::vector<Piece> pieces((spheres.size() + piece_size - 1) / piece_size);
  parallel_for(pieces.size(), [&](std::size_t i) {
    const std::size_t begin = i * piece_size, size = std::min(piece_size, spheres.size() - begin);
    survey(spheres.subspan(begin, size), first + static_cast<std::uint32_t>(begin), pieces[i]);
  });
  for (const Piece& piece : pieces) add(piece);
  for (const Sphere& sphere : spheres) sample_.add(sphere);
  for (std::size_t i = 0; i < spheres.size() && first_.size() < most_first; ++i)
    first_.push_back(spheres[i]);
  count_ += spheres.size();
}

PackedSpheres SphereSurvey::facts() const {
  PackedSpheres facts;
  facts.count = count_;
  facts.digest = digest_.value();
  facts.has_own_colors = has_own_colors_;
  facts.made_of = made_of_;
  facts.emissive = emissive_;
  facts.first = first_;
  facts.extremes = extremes_.spheres();
  if (count_ > 0) {
    facts.low = low_;
    facts.high = high_;
  }
  return facts;
}

std::vector<std::uint32_t> SphereSurvey::apart() const {
  std::vector<std::uint32_t> ids;
  if (size() <= tuning::most_scanned) {
    for (std::uint32_t id = 0; id < size(); ++id) ids.push_back(id);
    return ids;
  }
  std::vector<PackedSphere> giants, others = large_;
  // The box of the others shrinks as giants leave it: then more may be giants.
  for (bool found = true; found;) {
    BuildBox box = rest_;
    for (const PackedSphere& one : others) box.add(rough_box(one.sphere));
    const double most = tuning::giant_share * box.area();
    const auto first_giant = std::partition(
        others.begin(), others.end(),
        [most](const PackedSphere& one) { return !(rough_box(one.sphere).area() > most); });
    found = first_giant != others.end();
    giants.insert(giants.end(), first_giant, others.end());
    others.erase(first_giant, others.end());
  }
  ids = unfit_;
  for (const PackedSphere& giant : giants) ids.push_back(giant.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace boule
