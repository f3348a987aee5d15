#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/float_environment.h"
#include "core/math/geometry.h"
#include "render/files/particles/bonds/whole_molecules.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/particle_spheres.h"
#include "render/memory/available_memory.h"

// What particles show besides spheres.

namespace boule {
namespace {

/// Between white paper and a dark background.
constexpr SrgbColor edge_color{0x80, 0x80, 0x80};
/// Of x, y and z.
constexpr std::array<SrgbColor, 3> axis_colors{
    {{0xd8, 0x28, 0x28}, {0x28, 0x98, 0x30}, {0x28, 0x50, 0xd8}}};
/// Of the axes, by the longest side of the box around the spheres or, if that is longer, edge of
/// the cell.
constexpr double axis_length = 0.25, axis_radius = 0.008;

/// The column of a vector's x, y or z.
std::string arrow_column(const ParticleFrame& frame, const ArrowColumns& arrows, std::size_t axis) {
  if (arrows.names.size() == 3) return arrows.names[axis];
  const std::string name = arrows.names.front() + std::string(1, "xyz"[axis]);
  const std::string other = arrows.names.front() + "_" + std::string(1, "xyz"[axis]);
  return find_number_column(frame, other) != nullptr ? other : name;
}

bool is_capsule(double radius) { return radius > 0 && static_cast<float>(radius) > 0; }

/// Drops the capsules from `first` on, with an error, if one cannot be drawn.
Status check_capsules(std::vector<Capsule>& capsules, std::size_t first) {
  if (std::none_of(capsules.begin() + static_cast<std::ptrdiff_t>(first), capsules.end(),
                   [](const Capsule& one) { return find_problem(one).has_value(); })) {
    return {};
  }
  capsules.resize(first);
  return Diagnostic::about("file", "a bond or an arrow ends too far from the origin for a capsule");
}

}  // namespace

/// Finds the bonds, and gives the spheres the radii that go with them.
Status ParticleSpheres::add_bonds(const ParticleStyle& style, const BondPlan& plan,
                                  RadiusSource& source, const ParticleNamer& name_of,
                                  const ParallelFor& parallel_for) {
  ParticleFrame& frame = *frame_;
  if (style.bond_color)
    bond_look_.material = MaterialRef::colored(style.material, *style.bond_color);
  if (style.cell_edges) {
    edge_look_ = {cell_edge_radius(*frame.cell), MaterialRef::colored(style.material, edge_color)};
  }
  auto bonds = make_bonds(frame, plan, radii_, images_.size(), parallel_for);
  if (!bonds) return bonds.error();
  bonds_ = std::move(bonds).value();
  if (style.unwrap) {
    if (auto done = unwrap(plan, parallel_for); !done) return done;
  }
  const bool fills_space = plan.shape == ParticleShape::space_filling;
  if (fills_space && bonds_.empty() && !style.arrows) return {};
  double radius = choose_bond_radius(frame, style, plan, smallest_radius_, own_);
  if (plan.shape == ParticleShape::sticks) radius *= style.scale;
  bond_look_.radius = static_cast<float>(radius);
  if (frame.size() > 0 && !is_capsule(radius)) {
    return Diagnostic::about("bond_radius", "is too small or too large for a capsule");
  }
  if (fills_space || frame.size() == 0) return {};
  source = shaped_radii(std::move(source), frame, style, plan, radius / style.scale);
  auto radii = make_radii(frame, source, style.scale, name_of, parallel_for);
  if (!radii) return radii.error();
  radii_ = std::move(radii.value().radii);
  smallest_radius_ = radii.value().smallest;
  return {};
}

/// The bonds that are drawn or, if none are, those of the automatic rule.
Result<std::vector<Bond>> ParticleSpheres::any_bonds(const BondPlan& plan,
                                                     const ParallelFor& parallel_for) {
  if (plan.bonds != BondChoice(BondRule::none)) return bonds_;
  BondPlan automatic = plan;
  automatic.bonds = BondRule::automatic;
  return make_bonds(*frame_, automatic, radii_, 1, parallel_for);
}

/// Finds the groups that outlines go around.
Status ParticleSpheres::add_groups(const ParticleStyle& style, const BondPlan& plan,
                                   const ParallelFor& parallel_for) {
  OutlineChoice outline = style.outline_by;
  const bool is_open = std::holds_alternative<std::monostate>(outline);
  if (is_open && plan.shape == ParticleShape::sticks) outline = OutlineRule::depth;
  Result<std::vector<Bond>> bonds = std::vector<Bond>();
  if (needs_bonds(outline, *frame_)) bonds = any_bonds(plan, parallel_for);
  if (!bonds) return bonds.error();
  auto groups = make_groups(*frame_, outline, bonds.value());
  if (!groups) return groups.error();
  groups_ = std::move(groups).value();
  return {};
}

Status ParticleSpheres::append_groups_to(OutlineGroups& groups, std::size_t before) const {
  if (groups_.empty()) return {};
  if (auto done =
          check_memory(size() * sizeof(std::uint32_t), "groups of outlines need", "outline_by");
      !done) {
    return done;
  }
  const std::array<int, 3>& counts = images_.counts();
  groups.spheres.resize(before);
  groups.spheres.reserve(before + size());
  const auto add = [&](std::size_t particle, const ImagePlace& place) {
    groups.spheres.push_back(groups.largest + groups_.at(particle, place, counts));
  };
  for (std::size_t image = 0; image < images_.size(); ++image) {
    const ImagePlace place = images_.place(image);
    for (std::size_t i = 0; i < frame_->size(); ++i) add(i, place);
  }
  boundary_.each(add);
  const std::size_t of_images = groups_.of_images ? images_.size() : 1;
  groups.largest += groups_.count * static_cast<std::uint32_t>(of_images);
  return {};
}

/// Moves bonded particles together, along the bonds that are drawn or else those of the automatic
/// rule.
Status ParticleSpheres::unwrap(const BondPlan& plan, const ParallelFor& parallel_for) {
  ParticleFrame& frame = *frame_;
  auto found = any_bonds(plan, parallel_for);
  if (!found) return found.error();
  const auto endless = join_molecules(*frame.cell, plan.wraps, frame.positions, found.value());
  if (!endless) return endless.error();
  if (!bonds_.empty()) bonds_ = std::move(found).value();
  if (endless.value() == 0) return {};
  const std::string count = std::to_string(endless.value());
  frame.notes.push_back(
      endless.value() == 1
          ? "one molecule goes through the cell without end, and stays as it is"
          : count + " molecules go through the cell without end, and stay as they are");
  return {};
}

/// Reads the vectors that are drawn.
Status ParticleSpheres::add_arrows(const ParticleStyle& style) {
  if (!style.arrows || frame_->size() == 0) return {};
  if (auto done = check_memory(frame_->size() * (sizeof(Vec3d) + sizeof(Capsule) * images_.size()),
                               "the arrows need", "arrows");
      !done) {
    return done;
  }
  arrows_.resize(frame_->size());
  std::vector<double> numbers(frame_->size());
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column =
        find_particle_numbers(*frame_, arrow_column(*frame_, *style.arrows, k), "arrows");
    if (!column) return column.error();
    column.value().read(0, numbers.size(), numbers.data());
    double Vec3d::*const axis = std::array{&Vec3d::x, &Vec3d::y, &Vec3d::z}[k];
    for (std::size_t i = 0; i < numbers.size(); ++i)
      arrows_[i].*axis = numbers[i] * style.arrows->scale;
  }
  return {};
}

void ParticleSpheres::add_axes(const ParticleStyle& style) {
  if (!style.axes || frame_->size() == 0) return;
  float largest = 0;
  for (std::size_t i = 0; i < frame_->size(); ++i) largest = std::max(largest, radii_[i]);
  const Vec3d around = Vec3d{1, 1, 1} * double{largest};
  own_.axes_box = {bounds_[0] - around, bounds_[1] + around};
  axes_.emplace();
  for (std::size_t k = 0; k < axis_colors.size(); ++k)
    axes_->materials[k] = MaterialRef::colored(style.material, axis_colors[k]);
  const bool is_chosen = style.chosen != nullptr && style.chosen->axes_box;
  axes_->box = is_chosen ? *style.chosen->axes_box : *own_.axes_box;
}

Status ParticleSpheres::append_capsules_to(std::vector<Capsule>& capsules, const Vec3d& origin,
                                           OutlineGroups* groups) const {
  append_lines_to(capsules, origin);
  if (auto done = append_capsules_of(images_, &boundary_, capsules, origin, groups); !done)
    return done;
  return append_boundary_capsules_to(capsules, origin, groups);
}

Status ParticleSpheres::append_first_capsules_to(std::vector<Capsule>& capsules,
                                                 const Vec3d& origin) const {
  return append_capsules_of(CellImages(), nullptr, capsules, origin);
}

Status ParticleSpheres::append_boundary_capsules_to(std::vector<Capsule>& capsules,
                                                    const Vec3d& origin,
                                                    OutlineGroups* groups) const {
  const FloatEnvironment environment;
  const std::size_t first = capsules.size();
  const CellImages shown(frame_->cell.value_or(ParticleCell()), images_.counts());
  BondedParticles particles = bonded(shown, &boundary_, origin);
  particles.group_list = groups;
  append_boundary_bonds(particles, bonds_, bond_look_, capsules);
  if (!arrows_.empty()) {
    boundary_.each([&](std::size_t i, const ImagePlace& place) {
      add_arrow(i, (frame_->positions[i] - origin) + shown.shift(place), capsules);
    });
  }
  return check_capsules(capsules, first);
}

BondedParticles ParticleSpheres::bonded(const CellImages& images, const BoundaryImages* boundary,
                                        const Vec3d& origin) const {
  return {frame_->positions, radii_, materials_, frame_->cell, images, origin, boundary, &groups_};
}

void ParticleSpheres::add_arrow(std::size_t particle, const Vec3d& begin,
                                std::vector<Capsule>& capsules) const {
  const Vec3d& way = arrows_[particle];
  if (way == Vec3d{} || std::isnan(way.x + way.y + way.z)) return;  // none, or missing
  capsules.push_back({vec_cast<float>(begin), vec_cast<float>(begin + way), bond_look_.radius,
                      bond_look_.material.value_or(materials_[particle])});
}

void ParticleSpheres::append_lines_to(std::vector<Capsule>& capsules, const Vec3d& origin) const {
  if (edge_look_) {
    append_cell_edges(bonded(images_, &boundary_, origin), *edge_look_, capsules);
  }
  append_axes_to(capsules, origin);
}

/// Three lines from the corner of the cell or, without one, of the box around the spheres.
void ParticleSpheres::append_axes_to(std::vector<Capsule>& capsules, const Vec3d& origin) const {
  if (!axes_) return;
  Vec3d corner = axes_->box[0];
  const Vec3d sides = axes_->box[1] - corner;
  double longest = std::max({sides.x, sides.y, sides.z});
  if (frame_->cell) {
    const ParticleCell& cell = *frame_->cell;
    corner = cell.origin;
    for (const Vec3d& edge : {cell.a, cell.b, cell.c})
      longest = std::max(longest, std::sqrt(dot(edge, edge)));
  }
  const Vec3d begin = corner - origin;
  const double length = axis_length * longest;
  const std::array<Vec3d, 3> along{{{length, 0, 0}, {0, length, 0}, {0, 0, length}}};
  for (std::size_t k = 0; k < along.size(); ++k) {
    capsules.push_back({vec_cast<float>(begin), vec_cast<float>(begin + along[k]),
                        static_cast<float>(axis_radius * longest), axes_->materials[k]});
  }
}

Status ParticleSpheres::append_capsules_of(const CellImages& images, const BoundaryImages* boundary,
                                           std::vector<Capsule>& capsules, const Vec3d& origin,
                                           OutlineGroups* groups) const {
  const FloatEnvironment environment;
  if (bonds_.empty() && arrows_.empty()) return {};
  const std::size_t first = capsules.size();
  capsules.reserve(first + (2 * bonds_.size() + arrows_.size()) * images.size());
  const CellImages shown(frame_->cell.value_or(ParticleCell()), images.counts());
  BondedParticles particles = bonded(shown, boundary, origin);
  particles.group_list = groups;
  append_bonds(particles, bonds_, bond_look_, capsules);
  for (std::size_t image = 0; image < images.size() && !arrows_.empty(); ++image) {
    const Vec3d shift = images.shift(image);
    for (std::size_t i = 0; i < arrows_.size(); ++i)
      add_arrow(i, (frame_->positions[i] - origin) + shift, capsules);
  }
  return check_capsules(capsules, first);
}

}  // namespace boule
