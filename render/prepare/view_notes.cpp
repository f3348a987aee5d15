#include "render/prepare/view_notes.h"

#include <cstddef>

#include "core/optics/camera_ray.h"
#include "render/prepare/projection.h"

namespace boule {
namespace {

constexpr std::size_t sample_size = 4096;

/// Whether two pixels side by side, or one above the other, have the same direction as a ray. Only
/// those of orthographic rays are meant to, and those of a map of distortions may.
bool repeats_rays(const CameraView& camera, int width, int height) {
  if (camera.kind == CameraKind::orthographic || camera.distortion.st != nullptr) return false;
  for (const int part : {2, 4, 8}) {
    const double x = width / part + 0.5, y = height / part + 0.5;
    const Vec3f here = primary_ray(camera, x, y).dir;
    if (width > 1 && here == primary_ray(camera, x - 1, y).dir) return true;
    if (height > 1 && here == primary_ray(camera, x, y - 1).dir) return true;
  }
  return false;
}

bool are_small(const CameraView& camera, int width, int height,
               const std::vector<Sphere>& spheres) {
  if (camera.kind == CameraKind::lens) return false;
  const Projection projection(camera, width);
  if (!projection.keeps_lines()) return false;
  std::size_t shown = 0, small = 0;
  for (const Sphere& sphere : spheres) {
    const auto disc = projection.of(sphere);
    if (!disc || !(disc->x >= 0 && disc->x <= width && disc->y >= 0 && disc->y <= height)) continue;
    ++shown;
    small += 2 * disc->radius < 1 ? 1 : 0;
  }
  return small > shown / 2;
}

}  // namespace

std::vector<Sphere> sample_spheres(const Scene& scene,
                                   const std::optional<std::vector<ShownGroup>>& groups) {
  std::size_t total = scene.spheres.size();
  if (groups) {
    for (const ShownGroup& shown : *groups) total += scene.groups[shown.group].spheres.size();
  }
  const std::size_t step = total / sample_size + 1;
  std::vector<Sphere> sample;
  std::size_t next = 0;  // counted from the first sphere of the run
  for (; next < scene.spheres.size(); next += step) sample.push_back(scene.spheres[next]);
  next -= scene.spheres.size();
  if (!groups) return sample;
  for (const ShownGroup& shown : *groups) {
    const std::vector<Sphere>& spheres = scene.groups[shown.group].spheres;
    for (; next < spheres.size(); next += step)
      sample.push_back(transformed(spheres[next], shown.transform, shown.material));
    next -= spheres.size();
  }
  return sample;
}

std::vector<std::string> view_notes(const CameraView& camera, int width, int height,
                                    const std::vector<Sphere>& spheres) {
  std::vector<std::string> notes;
  if (repeats_rays(camera, width, height)) {
    notes.emplace_back(
        "neighbouring pixels have the same ray, whose direction is of 32-bit floats: come nearer "
        "with a wider field of view, or take an orthographic camera");
  }
  if (are_small(camera, width, height, spheres)) {
    notes.emplace_back(
        "most spheres are smaller than a pixel and may not show: make the picture or the radii "
        "larger, or come nearer");
  }
  return notes;
}

}  // namespace boule
