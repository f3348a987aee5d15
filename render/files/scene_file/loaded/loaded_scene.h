#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "core/scene/names.h"
#include "core/scene/scene.h"
#include "render/files/scene_file/loaded/particle_facts.h"

namespace boule {

class ParticleFileCache;
class SphereSource;
struct SceneData;

/// The treatment of an NFF polygon: its infinite plane, skipped, or an error.
enum class PolygonPolicy { plane, skip, error };

template <>
inline constexpr std::array<std::string_view, 3> names<PolygonPolicy>{"plane", "skip", "error"};

/// The options for reading a scene file.
struct SceneFileOptions {
  PolygonPolicy polygons = PolygonPolicy::plane;
  /// Of a series: selects the camera's position, the data files and the frame of a trajectory.
  std::optional<int> frame{};
  /// Of a series: how far it is to the next frame, 0 up to 1; particles (between_frames()) and
  /// cameras with keys are in between.
  double between = 0;
  /// Of a series: the choices of all its frames, where the scene file leaves them open.
  SeriesChoices choices{};
  /// Of a series: the origin, where the scene file leaves it open.
  std::optional<Vec3d> origin{};
  /// Of a series: keeps trajectories open for the next frame; null: off. For one thread at a time.
  ParticleFileCache* particle_files = nullptr;
  bool trust = false;  ///< packed scenes are left unchecked (PackedOptions)
  /// The number of spheres below which periodic images are expanded
  /// (ParticleSpheres::shares_images()).
  std::optional<std::uint64_t> fewest_shared{};
  const SceneData* data = nullptr;  ///< data in memory that replace named files; null: none
  /// Particles that are read part by part may stay outside the scene (LoadedScene::source), where
  /// they are all its spheres and nothing else needs them.
  bool may_stream = false;
  /// Runs the loops over particles.
  ParallelFor parallel_for = serial_for;
};

/// A scene that has passed validate(), warnings for the user, and the paths of the data files that
/// were read besides the scene file.
struct LoadedScene {
  Scene scene{};
  std::vector<std::string> warnings{};  ///< each "FILE:LINE: warning: TEXT"
  std::vector<std::string> data_files{};
  std::vector<std::string> notes{};        ///< automatic choices, a sentence each
  std::vector<ParticleFacts> particles{};  ///< of each file of particles
  /// Where the spheres come from that are not in the scene; null: all are in it. It uses the
  /// ParallelFor of SceneFileOptions, which outlives it.
  std::shared_ptr<SphereSource> source{};
  /// The scene's own point 0: it was subtracted, in double, from all points of the file before they
  /// were rounded. If you trace rays against the scene, subtract it from theirs, and add it to
  /// points of hits. If the file leaves it open, it is 0 where rounding goes unseen that way, else
  /// a point among the spheres.
  Vec3d origin{};
  /// The same for what is inside groups, by their index; of those beyond the end it is 0. The
  /// translations of instances make up for it.
  std::vector<Vec3d> group_origins{};

  [[nodiscard]] Vec3d origin_of(std::size_t group) const {
    return group < group_origins.size() ? group_origins[group] : Vec3d{};
  }
};

/// From where the translation of an instance is counted, so that it is that of the file; `origin`
/// is that of the scene or the group which the instance is in.
Vec3d shown_origin(const LoadedScene& loaded, const Instance& instance, const Vec3d& origin);

}  // namespace boule
