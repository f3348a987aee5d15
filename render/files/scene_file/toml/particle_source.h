#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "render/files/packed/sphere_source.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/particles/parted_spheres.h"

namespace boule {

/// The spheres of a frame that is read part by part.
class ParticleSource final : public SphereSource {
 public:
  /// `file` is that of the frame. `parallel_for` must outlive this object.
  ParticleSource(std::shared_ptr<ParticleFile> file, std::unique_ptr<PartedSpheres> spheres,
                 const ParallelFor& parallel_for)
      : file_(std::move(file)), spheres_(std::move(spheres)), parallel_for_(parallel_for) {}

  [[nodiscard]] const PartedSpheres& spheres() const { return *spheres_; }
  /// The point that is subtracted from centres before they are rounded.
  void set_origin(const Vec3d& origin) { origin_ = origin; }

  Status seek(std::uint64_t sphere) override;
  Status read(std::vector<Sphere>& part, std::size_t most) override;
  void forget(std::uint64_t) override {}

 private:
  std::shared_ptr<ParticleFile> file_;
  std::unique_ptr<PartedSpheres> spheres_;
  const ParallelFor& parallel_for_;
  Vec3d origin_;
  std::uint64_t next_ = 0;
};

}  // namespace boule
