#include "render/renderer/outline.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/math/geometry.h"
#include "core/optics/cameras.h"
#include "render/renderer/live_rays.h"

namespace boule {
namespace {

constexpr int chunk = 32;  // points a side that are traced together, as one bundle

PixelRect scaled(const PixelRect& rect, int factor) {
  return {rect.x0 * factor, rect.y0 * factor, rect.x1 * factor, rect.y1 * factor};
}

/// The rectangle and all points up to `margin` around it, cut off at the frame.
PixelRect widened(const PixelRect& rect, int margin, const PixelRect& frame) {
  return {std::max(rect.x0 - margin, frame.x0), std::max(rect.y0 - margin, frame.y0),
          std::min(rect.x1 + margin, frame.x1), std::min(rect.y1 + margin, frame.y1)};
}

/// The reach of a disc of this radius to either side, by the distance from its centre.
std::vector<int> disc_half_widths(double radius) {
  std::vector<int> widths;
  for (int dy = 0; static_cast<double>(dy) <= radius; ++dy) {
    int dx = static_cast<int>(radius) + 1;
    while (static_cast<double>(dx) * dx + static_cast<double>(dy) * dy > radius * radius) --dx;
    widths.push_back(dx);
  }
  return widths;
}

/// The discs of lines of 0, 1, 2, ... half pixels, and of this width.
std::vector<std::vector<int>> discs_of_lines(float width) {
  std::vector<std::vector<int>> discs;
  for (int halves = 0; 2 * static_cast<double>(width) > halves; ++halves) {
    discs.push_back(disc_half_widths(halves * outline_grid / 2.0));
  }
  discs.push_back(disc_half_widths(static_cast<double>(width) * outline_grid));
  return discs;
}

}  // namespace

void Outline::draw(Image& image) const {
  constexpr float all = most_ink;
  for (std::size_t i = 0; i < ink_.size(); ++i) {
    if (ink_[i] == 0) continue;
    const float left = 1 - static_cast<float>(ink_[i]) / all;
    const float alpha = image.alpha.empty() ? 1 : 1 - (1 - image.alpha[i]) * left;
    image.set(i, image.pixels[i] * left, alpha);
  }
}

OutlineWorker::OutlineWorker(const BlockSetup& setup, const Lines& lines)
    : setup_(setup),
      solver_(lines.solver),
      frame_(scaled(lines.frame, outline_grid)),
      width_(lines.width),
      discs_(discs_of_lines(lines.width)),
      order_(block_pixels(chunk)),
      fog_(lines.fog),
      search_(setup.scene, setup.kernels) {
  samples_.resize(chunk * chunk, setup.scene.camera_view);
  samples_.resize(2);
  rays_.resize(2);
  for (std::size_t k = 0; k < 2; ++k) {
    samples_.set(k, lines.frame.width() / 2.0 + static_cast<double>(k), lines.frame.height() / 2.0);
  }
  setup.kernels.primary_rays(setup.scene.camera_view, samples_.view(), rays_.view());
  const Ray a = rays_.get(0), b = rays_.get(1);
  step_org_ = b.org - a.org;
  step_dir_ = normalize(vec_cast<double>(b.dir)) - normalize(vec_cast<double>(a.dir));
}

void OutlineWorker::find(const PixelRect& block, Outline& outline) {
  marked_ = scaled(block, outline_grid);
  points_ = widened(marked_, static_cast<int>(discs_.back().size()) / 2 + 1, frame_);
  find_hits();
  if (fog_.strength > 0) clear_.assign(static_cast<std::size_t>(block.area()), 0);
  steps_.assign(
      static_cast<std::size_t>(marked_.height()) * (static_cast<std::size_t>(marked_.width()) + 1),
      0);
  mark_changes();
  count_points(block, outline);
}

void OutlineWorker::find_hits() {
  seen_.assign(static_cast<std::size_t>(points_.area()), Hit{});
  if (setup_.scene.clips > 0) surfaces_.assign(seen_.size(), no_primitive);
  if (fog_.strength > 0) veils_.assign(seen_.size(), 0);
  for (int y = points_.y0; y < points_.y1; y += chunk) {
    for (int x = points_.x0; x < points_.x1; x += chunk) {
      if (!is_bare(x, y)) trace(x, y);
    }
  }
}

/// Whether all rays of the chunk whose first point is (x0, y0) are certain to miss.
bool OutlineWorker::is_bare(int x0, int y0) const {
  const int x1 = std::min(x0 + chunk, points_.x1), y1 = std::min(y0 + chunk, points_.y1);
  for (int y = y0 / outline_grid; y * outline_grid < y1; ++y) {
    for (int x = x0 / outline_grid; x * outline_grid < x1; ++x) {
      if (!setup_.bare_pixels.is_bare(x, y)) return false;
    }
  }
  return true;
}

/// Traces the rays of the chunk whose first point is (x0, y0).
void OutlineWorker::trace(int x0, int y0) {
  const auto each_point = [&](const auto& visit) {
    std::size_t k = 0;
    for (const PixelOffset& offset : order_) {
      const int x = x0 + offset.x, y = y0 + offset.y;
      if (x < points_.x1 && y < points_.y1) visit(k++, x, y);
    }
    return k;
  };
  samples_.resize(chunk * chunk);
  const std::size_t count = each_point([this](std::size_t k, int x, int y) {
    samples_.set(k, (x + 0.5) / outline_grid, (y + 0.5) / outline_grid);
  });
  samples_.resize(count);
  const CameraView& camera = setup_.scene.camera_view;
  rays_.resize(count, common_part(camera.kind));
  setup_.kernels.primary_rays(camera, samples_.view(), rays_.view());
  if (camera.weighs) keep_live_rays(samples_, rays_);
  primary_ += rays_.size();
  hits_.resize(rays_.size());
  const Query query{solver_, Form::automatic, setup_.scene.central_coherence};
  search_.closest_hit(rays_.view(), query, hits_.view());
  const HitStream met = search_.surfaces(hits_.view(), caps_);
  std::size_t ray = 0;
  each_point([&](std::size_t k, int x, int y) {
    const bool has_ray = !camera.weighs || samples_.weight(k) != 0;
    if (!has_ray) return;
    if (!surfaces_.empty()) surfaces_[points_.index(x, y)] = met.id[ray];
    Hit& seen = seen_[points_.index(x, y)] = hits_.get(ray);
    const Vec3d dir = vec_cast<double>(rays_.dir(ray));
    if (fog_.strength > 0 && seen.id != no_primitive)
      veils_[points_.index(x, y)] = fog_.share(depth_of(camera, rays_.org(ray) + dir * seen.t));
    seen.t *= length(dir);
    ++ray;
  });
}

/// The radius of the sphere or capsule that was hit.
double OutlineWorker::radius_of(const Hit& hit) const {
  const Geometry& geometry = setup_.scene.geometry;
  return static_cast<double>(setup_.scene.is_capsule(hit) ? geometry.capsule(hit.slot).radius
                                                          : geometry.sphere(hit.slot).radius);
}

/// Whether a line goes between two points with these hits.
bool OutlineWorker::differ(const Hit& a, const Hit& b) const {
  if (a.id == b.id) return false;
  const PreparedScene& scene = setup_.scene;
  if (scene.outline_groups.empty() || a.id == no_primitive || b.id == no_primitive) return true;
  const std::uint32_t group = scene.outline_group(a);
  if (group == 0 || group != scene.outline_group(b)) return true;
  return !(std::fabs(a.t - b.t) <= outline_jump * radius_of(b.t < a.t ? b : a));
}

/// The line between two points with different hits.
const std::vector<int>& OutlineWorker::disc_between(const Hit& a, const Hit& b) const {
  const Hit& nearer = b.t < a.t ? b : a;
  if (nearer.id == no_primitive || setup_.scene.geometry.is_plane(nearer)) return discs_.back();
  const double pixel = length(step_org_ + step_dir_ * nearer.t);
  const bool is_grouped = setup_.scene.outline_group(nearer) != 0;
  const double share = is_grouped ? outline_group_share : outline_share;
  const double most = share * radius_of(nearer) / pixel;
  if (!(most < static_cast<double>(width_))) return discs_.back();
  return discs_[static_cast<std::size_t>(2 * most)];
}

/// Marks every point whose distance from a change is half the line's width or less. A change lies
/// in the middle between two neighbours that see different primitives, or a primitive and its cap.
void OutlineWorker::mark_changes() {
  const auto width = static_cast<std::size_t>(points_.width());
  const bool has_caps = !surfaces_.empty();
  const auto is_change = [&](std::size_t a, std::size_t b) {  // most neighbours see the same
    return (has_caps || seen_[a].id != seen_[b].id) && changes(a, b);
  };
  std::size_t at = 0;
  for (int y = points_.y0; y < points_.y1; ++y) {
    for (int x = points_.x0; x < points_.x1; ++x, ++at) {
      const Hit& here = hit(x, y);
      if (x + 1 < points_.x1 && is_change(at, at + 1)) {
        see_through_fog(at, at + 1);
        mark_beside(x, y, disc_between(here, hit(x + 1, y)));
      }
      if (y + 1 < points_.y1 && is_change(at, at + width)) {
        see_through_fog(at, at + width);
        mark_below(x, y, disc_between(here, hit(x, y + 1)));
      }
    }
  }
}

/// Marks the points around the middle between (x, y) and (x + 1, y), which is an odd number of
/// halves away from the columns of points, and an even one from the rows.
void OutlineWorker::mark_beside(int x, int y, const std::vector<int>& half_widths) {
  const auto rows = (static_cast<int>(half_widths.size()) - 1) / 2;
  for (int dy = -rows; dy <= rows; ++dy) {
    const int reach = (half_widths[2 * static_cast<std::size_t>(std::abs(dy))] + 1) / 2;
    mark(y + dy, x + 1 - reach, x + reach);
  }
}

/// The same for the middle between (x, y) and (x, y + 1).
void OutlineWorker::mark_below(int x, int y, const std::vector<int>& half_widths) {
  const auto rows = static_cast<int>(half_widths.size()) / 2;
  for (int dy = 1 - rows; dy <= rows; ++dy) {
    const int reach = half_widths[static_cast<std::size_t>(std::abs(2 * dy - 1))] / 2;
    mark(y + dy, x - reach, x + reach);
  }
}

/// The lines that are marked next go around the nearer of two points.
void OutlineWorker::see_through_fog(std::size_t a, std::size_t b) {
  if (fog_.strength > 0) seen_now_ = 1 - veils_[seen_[b].t < seen_[a].t ? b : a];
}

/// Marks points first .. last of a row, as far as they are in the block.
void OutlineWorker::mark(int y, int first, int last) {
  first = std::max(first, marked_.x0);
  last = std::min(last, marked_.x1 - 1);
  if (y < marked_.y0 || y >= marked_.y1 || first > last || seen_now_ == 0) return;
  int* const row = steps_.data() + static_cast<std::ptrdiff_t>(y - marked_.y0) *
                                       (static_cast<std::ptrdiff_t>(marked_.width()) + 1);
  ++row[first - marked_.x0];
  --row[last + 1 - marked_.x0];
  if (!(fog_.strength > 0)) return;
  const int width = marked_.width() / outline_grid;
  const auto first_of_row = static_cast<std::size_t>((y - marked_.y0) / outline_grid * width);
  for (int x = (first - marked_.x0) / outline_grid; x <= (last - marked_.x0) / outline_grid; ++x) {
    float& clear = clear_[first_of_row + static_cast<std::size_t>(x)];
    clear = std::max(clear, seen_now_);
  }
}

void OutlineWorker::count_points(const PixelRect& block, Outline& outline) const {
  std::vector<int> counts(static_cast<std::size_t>(block.width()));
  const int* step = steps_.data();
  for (int y = block.y0; y < block.y1; ++y) {
    std::fill(counts.begin(), counts.end(), 0);
    for (int row = 0; row < outline_grid; ++row, ++step) {
      int lines = 0;
      for (int x = 0; x < marked_.width(); ++x, ++step) {
        lines += *step;
        counts[static_cast<std::size_t>(x / outline_grid)] += lines > 0 ? 1 : 0;
      }
    }
    for (int x = block.x0; x < block.x1; ++x) {
      int ink = ink_of_point * counts[static_cast<std::size_t>(x - block.x0)];
      if (fog_.strength > 0)
        ink = static_cast<int>(static_cast<float>(ink) * clear_[block.index(x, y)] + 0.5F);
      outline.set(x, y, ink);
    }
  }
}

}  // namespace boule
