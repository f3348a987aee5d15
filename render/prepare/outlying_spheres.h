#pragma once

#include <optional>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace boule {

/// A sphere with the median of the radii, where the median of each coordinate of the centres is. It
/// does not depend on the order of the spheres. None without spheres, and of scenes whose spheres
/// are packed or shown by instances.
std::optional<Sphere> median_sphere(const Scene& scene);

/// Whether the median sphere may be smaller than a pixel: by some thousand spheres. Precondition:
/// the camera is a fitted one.
bool may_be_specks(const Scene& scene, const Camera& camera, int width, int height);

/// True of the spheres that do not lie far from all others: not farther from the median centre than
/// twice the distance within which 99.5 % of the centres lie.
class NearOthers {
 public:
  /// Precondition: the scene has a median_sphere(), which is `median`.
  NearOthers(const Scene& scene, const Sphere& median);
  bool operator()(const Sphere& sphere) const;

 private:
  Vec3f center_;
  float reach_;
};

/// The scene with these spheres alone. Its camera's settings and its planes and capsules are kept,
/// all else is left out. None if these are all of its spheres. Precondition: as above.
std::optional<Scene> without_outliers(const Scene& scene, const Sphere& median);

/// The diameter of a sphere in pictures of this size, in pixels. Precondition: the camera is a
/// fitted one. Infinity if it does not see the sphere's middle.
double pixels_across(const Sphere& sphere, const Camera& camera, int width, int height);

/// Whether a camera is given another one, to which spheres far from all others do not matter: by
/// the first the median sphere is smaller than a pixel, and by the other at least twice as large.
bool is_better_without(const Sphere& median, const Camera& all, const Camera& near, int width,
                       int height);

}  // namespace boule
