#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/srgb.h"
#include "core/math/vec.h"
#include "core/scene/material_ref.h"
#include "core/scene/outline_groups.h"
#include "core/scene/primitive.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/bonds/bond_capsules.h"
#include "render/files/particles/bonds/particle_bonds.h"
#include "render/files/particles/boundary_images.h"
#include "render/files/particles/cell_images.h"
#include "render/files/particles/colors/color_meaning.h"
#include "render/files/particles/particle_choices.h"
#include "render/files/particles/particle_groups.h"
#include "render/files/particles/particle_labels.h"
#include "render/files/particles/particle_style.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// The spheres of one frame, before they are rounded: which particles are shown, their images,
/// radii and colours.
class ParticleSpheres {
 public:
  /// Errors have a message and, as their key, the key of [[particles]] that is at fault ("file",
  /// "select", "radius", "scale", "color", "color.by", "color.range", "material", "outline_by",
  /// "wrap", "unwrap", "boundary", "replicate", "labels", "label_text", "ghost"): an unknown column
  /// (with the one that was meant, if any), a radius that is not above 0 or not finite with its
  /// particle (from 1, in the order of the frame), no cell to wrap into, more spheres than there is
  /// memory for or than ids allow. Throws std::bad_alloc. The same for any threads.
  static Result<ParticleSpheres> make(ParticleFrame read, const ParticleStyle& style,
                                      const ParallelFor& parallel_for = serial_for);

  /// Spheres, images included.
  [[nodiscard]] std::size_t size() const {
    return frame_->size() * images_.size() + boundary_.size();
  }

  /// The smallest box of the spheres' centres; two equal corners where there are none.
  [[nodiscard]] const std::array<Vec3d, 2>& center_bounds() const { return bounds_; }
  /// 0 where there are no spheres.
  [[nodiscard]] double smallest_radius() const { return smallest_radius_; }
  [[nodiscard]] const ParticleColors& colors() const { return colors_; }
  /// How radii were chosen: "the column radius", "van der Waals radii, in angstrom", ...
  [[nodiscard]] const std::string& radius_source() const { return radius_source_; }
  [[nodiscard]] const std::optional<ParticleCell>& cell() const { return frame_->cell; }
  /// False if the axes of coordinates are arbitrary: they are so in the frame, which has species.
  [[nodiscard]] bool axes_matter() const { return frame_->axes_matter || !frame_->species; }
  /// What the frame by itself has for what is chosen: the frames of a series are added up.
  [[nodiscard]] const ParticleChoices& own_choices() const { return own_; }
  /// What was decided for the user, a sentence each; the frame's own are among them.
  [[nodiscard]] const std::vector<std::string>& notes() const { return frame_->notes; }

  /// Appends the spheres: `origin` is subtracted in double, then all is rounded to float, once.
  /// The particles come in the order of the file, all of one image before those of the next
  /// (CellImages), and last what is repeated on faces (BoundaryImages). An error, and no sphere
  /// more, if a centre is too large for a float or there is no memory. It uses the particles up:
  /// their memory goes back to the system as the spheres appear, so that both never stand there
  /// whole.
  Status append_to(std::vector<Sphere>& spheres, const Vec3d& origin,
                   const ParallelFor& parallel_for = serial_for) &&;

  /// Appends the capsules: bonds, edges of the cell, axes, arrows. To be called before the spheres
  /// are appended, with the same origin. An error, and no capsule more, as of spheres. The groups
  /// of bonds are put where the capsules are; to be called before append_groups_to().
  Status append_capsules_to(std::vector<Capsule>& capsules, const Vec3d& origin,
                            OutlineGroups* groups = nullptr) const;
  /// Whether outlines go around groups.
  [[nodiscard]] bool has_groups() const { return !groups_.empty(); }
  /// Puts the groups of the spheres that append_to() appends behind `before` others. To be called
  /// before that. An error if there is no memory.
  Status append_groups_to(OutlineGroups& groups, std::size_t before) const;
  /// The same of the first image only; pieces of bonds meet where images do.
  Status append_first_capsules_to(std::vector<Capsule>& capsules, const Vec3d& origin) const;
  /// What is repeated on faces: spheres, and bonds and arrows.
  Status append_boundary_to(std::vector<Sphere>& spheres, const Vec3d& origin) const;
  Status append_boundary_capsules_to(std::vector<Capsule>& capsules, const Vec3d& origin,
                                     OutlineGroups* groups = nullptr) const;
  /// The edges of the cell and the axes only, which all images have together.
  void append_lines_to(std::vector<Capsule>& capsules, const Vec3d& origin) const;
  /// Bonds of the particles, those of images not among them.
  [[nodiscard]] std::size_t bonds() const { return bonds_.size(); }

  [[nodiscard]] const std::vector<ParticleLabel>& labels() const { return labels_; }

  /// Whether there are so many images that they had better be instances of the first one.
  [[nodiscard]] bool shares_images(std::uint64_t fewest_spheres = fewest_shared) const;
  static constexpr std::uint64_t fewest_shared = 1U << 24;  ///< spheres, images included
  /// The same as append_to() for the first image only.
  Status append_first_image_to(std::vector<Sphere>& spheres, const Vec3d& origin,
                               const ParallelFor& parallel_for = serial_for) &&;
  [[nodiscard]] const CellImages& images() const { return images_; }

 private:
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  struct AxesLook {
    std::array<MaterialRef, 3> materials;  ///< of x, y, z
    std::array<Vec3d, 2> box;              ///< around the spheres, in a series around all of them
  };

  Status add_bonds(const ParticleStyle& style, const BondPlan& plan, RadiusSource& source,
                   const ParticleNamer& name_of, const ParallelFor& parallel_for);
  Result<std::vector<Bond>> any_bonds(const BondPlan& plan, const ParallelFor& parallel_for);
  Status add_groups(const ParticleStyle& style, const BondPlan& plan,
                    const ParallelFor& parallel_for);
  Status add_arrows(const ParticleStyle& style);
  void add_axes(const ParticleStyle& style);
  [[nodiscard]] BondedParticles bonded(const CellImages& images, const BoundaryImages* boundary,
                                       const Vec3d& origin) const;
  Status append_capsules_of(const CellImages& images, const BoundaryImages* boundary,
                            std::vector<Capsule>& capsules, const Vec3d& origin,
                            OutlineGroups* groups = nullptr) const;
  void add_arrow(std::size_t particle, const Vec3d& begin, std::vector<Capsule>& capsules) const;
  void append_axes_to(std::vector<Capsule>& capsules, const Vec3d& origin) const;
  void keep_own(ParticleChoices colors);
  Status wrap(const ParticleStyle& style, const ParallelFor& parallel_for);
  Status unwrap(const BondPlan& plan, const ParallelFor& parallel_for);
  Status find_bounds(const ParticleStyle& style, const ParallelFor& parallel_for);
  Status append_images_to(std::vector<Sphere>& spheres, std::size_t images, const Vec3d& origin,
                          const ParallelFor& parallel_for);
  std::size_t make_spheres(const Range& range, const Vec3d& origin, Sphere* spheres,
                           const ParallelFor& parallel_for) const;
  void let_go(std::size_t begin, std::size_t end);

  /// The particles that are shown, with the columns that the next two look into.
  std::unique_ptr<ParticleFrame> frame_;
  ParticleValues<float> radii_;
  ParticleValues<MaterialRef> materials_;
  CellImages images_;
  BoundaryImages boundary_;
  std::vector<Bond> bonds_;
  ParticleGroups groups_;
  BondLook bond_look_;
  std::optional<BondLook> edge_look_;  ///< if the edges of the cell are drawn
  std::optional<AxesLook> axes_;       ///< if they are drawn
  std::vector<Vec3d> arrows_;          ///< of each particle; empty: none
  std::vector<ParticleLabel> labels_;
  std::array<Vec3d, 2> bounds_{};
  double smallest_radius_ = 0;
  ParticleColors colors_;
  std::string radius_source_;
  ParticleChoices own_;
};

}  // namespace boule
