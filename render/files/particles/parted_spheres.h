#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "core/scene/primitive.h"
#include "render/files/particle_file/frame/particle_reader.h"
#include "render/files/particles/colors/color_meaning.h"
#include "render/files/particles/particle_style.h"

namespace boule {

/// What of a style looks at all particles of a frame, "the radius is found from all particles";
/// empty if nothing does: then a part of the frame has the spheres that it has in the whole one.
/// `some`: a part, with one particle at least if the frame has any.
std::string what_needs_all(const ParticleFrame& some, const ParticleStyle& style);

/// The spheres of a frame that is read part by part and need not fit into memory. They are those of
/// ParticleSpheres, in the same order.
class PartedSpheres {
 public:
  static constexpr std::size_t particles_of_part = std::size_t{1} << 18;

  /// Reads the frame once. Errors are those of ParticleSpheres::make(), and those of FrameParts
  /// about "file".
  /// Precondition: what_needs_all() is empty.
  static Result<std::unique_ptr<PartedSpheres>> make(std::unique_ptr<FrameParts> frame,
                                                     const ParticleStyle& style,
                                                     const ParallelFor& parallel_for);

  [[nodiscard]] std::uint64_t particles() const { return frame_->size(); }
  [[nodiscard]] std::uint64_t size() const { return starts_.back(); }
  /// As ParticleSpheres.
  [[nodiscard]] const std::array<Vec3d, 2>& center_bounds() const { return bounds_; }
  [[nodiscard]] double smallest_radius() const { return smallest_radius_; }
  [[nodiscard]] const ParticleColors& colors() const { return colors_; }
  [[nodiscard]] const std::string& radius_source() const { return radius_source_; }
  [[nodiscard]] const std::optional<ParticleCell>& cell() const { return cell_; }
  [[nodiscard]] const std::optional<double>& time() const { return time_; }
  [[nodiscard]] bool axes_matter() const { return axes_matter_; }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

  /// The part that has this sphere, and the number of its first sphere.
  struct Place {
    std::size_t part;
    std::uint64_t first;
  };
  /// Precondition: sphere < size().
  [[nodiscard]] Place part_of(std::uint64_t sphere) const;
  /// The spheres of a part, counted from `origin`, in place of those that are in `spheres`.
  Status read(std::size_t part, const Vec3d& origin, std::vector<Sphere>& spheres,
              const ParallelFor& parallel_for);

 private:
  PartedSpheres(std::unique_ptr<FrameParts> frame, const ParticleStyle& style)
      : frame_(std::move(frame)), style_(style) {}
  [[nodiscard]] std::size_t parts() const;
  Result<ParticleFrame> frame_of(std::size_t part);
  Status add(std::size_t part, const ParallelFor& parallel_for);

  std::unique_ptr<FrameParts> frame_;
  ParticleStyle style_;
  std::vector<std::uint64_t> starts_{0};  ///< of each part, and the end of the last one
  std::array<Vec3d, 2> bounds_{};
  double smallest_radius_ = 0;
  ParticleColors colors_;
  std::string radius_source_;
  std::optional<ParticleCell> cell_;
  std::optional<double> time_;
  bool axes_matter_ = true;
  std::vector<std::string> notes_;
};

}  // namespace boule
