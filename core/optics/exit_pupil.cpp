#include "core/optics/exit_pupil.h"

#include <algorithm>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

/// Whether a ray passes the lens, from a film point at the distance r from the axis through (x, y)
/// of the plane through the rear vertex.
bool passes(const LensOptics& optics, double r, double x, double y) {
  Vec3d org{r, 0, optics.film};
  Vec3d dir = normalize(Vec3d{x, y, optics.rear} - org);
  return trace_lens(optics.elements, org, dir);
}

double last_radius(const LensOptics& optics) {
  return std::sqrt(optics.elements.front().aperture2);
}

/// The largest distance of a pupil from the axis. Rays meet a curved rear surface beyond the plane
/// of its vertex, so that in this plane the pupil may be wider than the surface.
double reach(const LensOptics& optics) { return 1.5 * last_radius(optics); }

// ---- In the middle of the film.

constexpr double narrowest = 1e-9;  // as a fraction of the last surface

/// The radius at which rays begin or cease to pass, between two radii of which one passes and the
/// other is stopped. By halving, to the last bit.
double edge_between(const LensOptics& optics, double inner, double outer) {
  const bool within = passes(optics, 0, inner, 0);
  for (double middle = (inner + outer) / 2; inner < middle && middle < outer;
       middle = (inner + outer) / 2) {
    (passes(optics, 0, middle, 0) == within ? inner : outer) = middle;
  }
  return outer;
}

/// Calls found(inner, outer) with the radii of the pupil's disc, and of each ring around it: where
/// outer rays are bent too strongly, a pupil may have rings. From the axis outwards.
template <class Found>
void visit_zones(const LensOptics& optics, Found found) {
  constexpr double step = 1.006;
  const double least = narrowest * last_radius(optics), most = 2 * reach(optics);
  double inner = 0, last = least;
  bool within = passes(optics, 0, least, 0);
  for (double radius = least * step; radius < most; last = radius, radius *= step) {
    if (passes(optics, 0, radius, 0) == within) continue;
    const double edge = edge_between(optics, last, radius);
    if (within) found(inner, edge);
    inner = edge;
    within = !within;
  }
  if (within) found(inner, last);
}

/// The integral of cos^4 over a disc of this radius squared, at this distance squared. With
/// cos^2 = d^2 / (d^2 + x^2) it is that of 2 pi x cos^4 dx.
double light_of_disc(double radius2, double distance2) {
  return elementary::pi * distance2 * radius2 / (distance2 + radius2);
}

// ---- Elsewhere on the film: boxes.

constexpr PupilBox nowhere{0, 0, 0};

bool is_empty(const PupilBox& box) { return !(box.x0 < box.x1); }

PupilBox widened(const PupilBox& box, double x, double y) {
  return {box.x0 - x, box.x1 + x, box.y + y};
}

/// A stretch of the x axis of the plane through the rear vertex; empty where x0 >= x1.
struct Stretch {
  double x0, x1;
};

bool is_empty(const Stretch& stretch) { return !(stretch.x0 < stretch.x1); }

Stretch join(const Stretch& a, const Stretch& b) {
  if (is_empty(a) || is_empty(b)) return is_empty(a) ? b : a;
  return {std::min(a.x0, b.x0), std::max(a.x1, b.x1)};
}

/// The part of a stretch through which a film point sees, a step longer at both ends. The axis is
/// enough: the pupil is symmetric about it, so a pupil of one piece meets it.
Stretch seen_through(const LensOptics& optics, const Stretch& stretch, double r, int steps) {
  const double step = (stretch.x1 - stretch.x0) / steps;
  Stretch seen{stretch.x1, stretch.x0};
  for (int i = 0; i < steps; ++i) {
    const double x = stretch.x0 + (i + 0.5) * step;
    if (!passes(optics, r, x, 0)) continue;
    seen = {std::min(seen.x0, x - step), std::max(seen.x1, x + step)};
  }
  return seen;
}

/// The range of the pupil on the x axis. A narrow stop's pupil would fall between two steps. So the
/// search begins with all apertures widened to a least width, and divides that width by eight each
/// time, within the range found before: a wider stop lets all rays through that a narrower one
/// does.
Stretch stretch_of(const LensOptics& optics, double r) {
  constexpr int steps = 256;
  LensOptics wider = optics;
  Stretch stretch{-reach(optics), reach(optics)};
  bool narrow = true;
  for (double least = reach(optics) / 16; narrow && !is_empty(stretch); least /= 8) {
    narrow = false;
    for (std::size_t i = 0; i < optics.elements.size(); ++i) {
      const double aperture2 = optics.elements[i].aperture2;
      wider.elements[i].aperture2 = std::max(aperture2, least * least);
      narrow = narrow || aperture2 < least * least;
    }
    stretch = seen_through(wider, stretch, r, steps);
  }
  return narrow ? seen_through(optics, stretch, r, steps) : stretch;
}

/// The first of `count` steps from `from` on along a row that passes, or `count`.
int first_seen(const LensOptics& optics, double r, double from, double step, double y, int count) {
  int i = 0;
  while (i < count && !passes(optics, r, from + (i + 0.5) * step, y)) ++i;
  return i;
}

/// The part of a box through which a film point sees, a cell wider on all sides. It is found in the
/// half with y > 0, because the other half mirrors it; in each row from both ends up to the pupil.
PupilBox seen_through(const LensOptics& optics, const PupilBox& box, double r) {
  constexpr int cells = 64;
  const double step_x = (box.x1 - box.x0) / cells, step_y = 2 * box.y / cells;
  int left = cells, right = cells, top = 0;
  for (int j = 0; j < cells / 2; ++j) {
    const double y = (j + 0.5) * step_y;
    const int first = first_seen(optics, r, box.x0, step_x, y, cells);
    if (first == cells) continue;
    left = std::min(left, first);
    right = std::min(right, first_seen(optics, r, box.x1, -step_x, y, cells));
    top = j + 1;
  }
  if (left == cells) return nowhere;
  return {box.x0 + (left - 0.5) * step_x, box.x1 - (right - 0.5) * step_x, (top + 0.5) * step_y};
}

/// Whether any ray passes on the outline of a box. If so, the pupil continues outside of it.
bool is_crossed(const LensOptics& optics, const PupilBox& box, double r) {
  constexpr int points = 64;
  for (int i = 0; i <= points; ++i) {
    const double x = box.x0 + (box.x1 - box.x0) * i / points, y = box.y * i / points;
    if (passes(optics, r, box.x0, y) || passes(optics, r, box.x1, y) ||
        passes(optics, r, x, box.y)) {
      return true;
    }
  }
  return false;
}

/// The pupil's box, made from one that the pupil meets. The box grows until its outline stops all
/// rays, and shrinks until the pupil fills it: then the cells are small beside the pupil.
PupilBox fitted(const LensOptics& optics, PupilBox box, double r) {
  constexpr int most_rounds = 16;
  constexpr double growth = 0.25, filled = 0.75;
  for (int round = 0; round < most_rounds && !is_empty(box); ++round) {
    const PupilBox seen = seen_through(optics, box, r);
    const double width = seen.x1 - seen.x0;
    const bool crossed = !is_empty(seen) && is_crossed(optics, seen, r);
    const bool fills = width >= filled * (box.x1 - box.x0) && seen.y >= filled * box.y;
    box = crossed ? widened(seen, growth * width, growth * seen.y) : seen;
    if (fills && !crossed) break;
  }
  return box;
}

/// The exit pupil of a film point. `near` is that of a point nearby. Around it the steps are finer,
/// and find pupils that are too narrow for the steps over the whole width.
PupilBox pupil_of(const LensOptics& optics, const PupilBox& near, double r) {
  const double width = near.x1 - near.x0;
  const Stretch close = seen_through(optics, {near.x0 - width, near.x1 + width}, r, 128);
  const Stretch all = join(stretch_of(optics, r), close);
  if (is_empty(all)) return nowhere;
  return fitted(optics, {all.x0, all.x1, std::max((all.x1 - all.x0) / 2, near.y)}, r);
}

/// The box of the film's middle, where the pupil is a disc; wider than it, as boxes elsewhere are.
PupilBox middle_box(double radius) {
  const double edge = radius * (1 + 1.0 / 64);
  return {-edge, edge, edge};
}

/// The ring between two film points. Both boxes are widened until the one half way between them
/// holds its own pupil; by the same on both sides, so that the boxes' middles are continuous from
/// ring to ring.
PupilRing ring_of(PupilBox inner, const PupilBox& middle, PupilBox outer) {
  if (is_empty(inner)) inner = is_empty(outer) ? middle : outer;
  if (is_empty(outer)) outer = inner;
  if (is_empty(middle)) return {inner, outer};
  const double x0 = (inner.x0 + outer.x0) / 2, x1 = (inner.x1 + outer.x1) / 2;
  const double x = std::max({x0 - middle.x0, middle.x1 - x1, 0.0});
  const double y = std::max(middle.y - (inner.y + outer.y) / 2, 0.0);
  return {widened(inner, x, y), widened(outer, x, y)};
}

}  // namespace

double light_in_the_middle(const LensOptics& optics) {
  const double distance = optics.film - optics.rear, distance2 = distance * distance;
  double light = 0;
  visit_zones(optics, [&](double inner, double outer) {
    light += light_of_disc(outer * outer, distance2) - light_of_disc(inner * inner, distance2);
  });
  return light;
}

void find_pupil(LensOptics& optics, int rings) {
  const double corner =
      std::sqrt(optics.half_width * optics.half_width + optics.half_height * optics.half_height);
  double radius = 0;
  visit_zones(optics, [&](double, double outer) { radius = outer; });
  optics.exposure = 1 / light_in_the_middle(optics);
  PupilBox inner = middle_box(radius);
  optics.pupil.clear();
  for (int ring = 0; ring < rings; ++ring) {
    const PupilBox middle = pupil_of(optics, inner, corner * (ring + 0.5) / rings);
    const PupilBox outer =
        pupil_of(optics, is_empty(middle) ? inner : middle, corner * (ring + 1) / rings);
    optics.pupil.push_back(ring_of(inner, middle, outer));
    inner = outer;
  }
  optics.rings_per_length = rings / corner;
}

}  // namespace boule
