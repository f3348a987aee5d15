#include <cmath>

#include "core/optics/lens_optics.h"
#include "core/scene/problem_finder.h"

namespace boule {
namespace {

void check_up(ProblemFinder& finder, const Vec3d& view, const Vec3f& up) {
  const Vec3d upward = normalize(vec_cast<double>(up));
  finder.require("up", length(cross(view, upward)) > 1e-6,
                 "must not be within 1e-6 rad of the view direction");
}

/// Checks one surface by itself, and its width against that of the last one.
void check_surface(ProblemFinder& finder, const LensCamera& camera, std::size_t i) {
  const LensSurface& surface = camera.surfaces[i];
  const std::string its = "surface " + std::to_string(i + 1) + ": its ";
  if (const auto bad = first_problem(surface)) {
    finder.require("file", false, its + bad->field + " " + bad->message);
  }
  const double width = surface.aperture, last = camera.surfaces.back().aperture;
  finder.require("file", !(width < least_width * last),
                 its + "aperture is less than a 500th of the last one's");
}

}  // namespace

void check_whole(ProblemFinder& finder, const CameraPose& pose) {
  finder.require("look_at", !(pose.eye == pose.look_at), "must differ from eye");
  check_up(finder, view_direction(pose), pose.up);
}

void check_whole(ProblemFinder& finder, const CameraFit& fit) {
  finder.require("pose", fit.pose != FittedPose::principal || !(fit.direction || fit.up),
                 "principal takes neither a direction nor an up");
  finder.require("room", 2 * fit.margin + fit.room < 1, "must leave some of the picture");
  if (!fit.direction || !fit.up) return;
  check_up(finder, normalize(vec_cast<double>(*fit.direction)), *fit.up);
}

void check_whole(ProblemFinder& finder, const LensSurface& surface) {
  finder.require("aperture",
                 surface.radius == 0 || surface.aperture <= 2 * std::fabs(surface.radius),
                 "is wider than its sphere");
}

void check_whole(ProblemFinder& finder, const LensCamera& camera) {
  finder.require("file", !camera.surfaces.empty(), "must have surfaces");
  for (std::size_t i = 0; i < camera.surfaces.size(); ++i) check_surface(finder, camera, i);
  if (finder.problem()) return;
  const double focal = focal_length(camera.surfaces);
  finder.require("file", std::isfinite(focal) && focal > 0, "must gather light, to a focus");
  const double focus = focus_of(camera.pose, camera.focus);
  const double behind = image_distance(camera.surfaces, focus / double{camera.scale});
  finder.require("focus", std::isfinite(behind) && behind > 0,
                 "is nearer than the lens can be focused");
  if (finder.problem()) return;
  finder.require("file", std::isfinite(1 / gathered_light(camera)),
                 "lets no light to the middle of the film at this focus");
}

std::optional<Problem> find_problem(const Camera& camera) {
  return std::visit([](const auto& kind) { return first_problem(kind); }, camera);
}

std::optional<Problem> find_problem(const CameraFit& fit) { return first_problem(fit); }

}  // namespace boule
