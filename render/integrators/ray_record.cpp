#include "render/integrators/ray_record.h"

#include <algorithm>

#include "render/integrators/sample_faults.h"

namespace boule {

void RayRecord::start() {
  rays_.clear();
  full_ = false;
  children_.clear();
  waiting_ = {{RayKind::primary, -1, gray(1)}};
}

/// The order is that of Wavefront: the first child comes first, and all that follows from it.
void RayRecord::begin(const Ray& ray, const Hit& hit, const Hit& met, const Color& throughput) {
  while (!children_.empty()) {
    waiting_.push_back(children_.back());
    children_.pop_back();
  }
  const Expected expected = waiting_.back();
  waiting_.pop_back();
  current_ = rays_.size();
  const int depth =
      expected.parent < 0 ? 0 : rays_[static_cast<std::size_t>(expected.parent)].depth + 1;
  rays_.push_back({.kind = expected.kind,
                   .parent = expected.parent,
                   .depth = depth,
                   .ray = ray,
                   .hit = hit,
                   .met = met,
                   .weight = expected.weight,
                   .throughput = throughput,
                   .own = {}});
  if (rays_.size() >= most_rays) full_ = true;
}

void RayRecord::add_shadow(std::size_t light, const Ray& ray, const Hit& hit,
                           const Color& arriving) {
  const RecordedRay& from = rays_[current_];
  rays_.push_back({.kind = RayKind::shadow,
                   .parent = static_cast<int>(current_),
                   .depth = from.depth,
                   .ray = ray,
                   .hit = hit,
                   .met = {},
                   .weight = gray(1),
                   .throughput = from.throughput,
                   .own = arriving,
                   .light = light});
}

void RayRecord::expect(RayKind kind, const Color& weight) {
  children_.push_back({kind, static_cast<int>(current_), weight});
}

void RayRecord::finish(const Color& own) { rays_[current_].own = own; }

Color RayRecord::total() const {
  int deepest = 0;
  for (const RecordedRay& ray : rays_) deepest = std::max(deepest, ray.depth);
  Color total;
  for (int depth = 0; depth <= deepest; ++depth) {
    Color sum;
    for (const RecordedRay& ray : rays_) {
      if (ray.depth != depth || ray.kind == RayKind::shadow) continue;
      sum = sum + light_product(ray.throughput, ray.own);
    }
    total = total + sum;
  }
  return total;
}

std::vector<Color> RayRecord::returned() const {
  std::vector<std::vector<std::size_t>> children(rays_.size());
  for (std::size_t i = 1; i < rays_.size(); ++i) {
    if (rays_[i].kind != RayKind::shadow)
      children[static_cast<std::size_t>(rays_[i].parent)].push_back(i);
  }
  std::vector<Color> returned(rays_.size());
  // Children stand behind their parents: what they return is known first.
  for (std::size_t i = rays_.size(); i-- > 0;) {
    returned[i] = rays_[i].own;
    for (const std::size_t child : children[i])
      returned[i] = returned[i] + light_product(rays_[child].weight, returned[child]);
  }
  return returned;
}

}  // namespace boule
