#include "render/files/particles/parted_spheres.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "render/files/particles/colors/particle_colors.h"
#include "render/files/particles/elements.h"
#include "render/files/particles/ionic_radii.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/particle_spheres.h"

namespace boule {
namespace {

bool are_all_listed(const ParticleFrame& some, const ParticleStyle& style, RadiusTable table) {
  if (!some.species) return false;
  const auto& texts = some.species->texts;
  return std::all_of(texts.begin(), texts.end(), [&](const std::string& text) {
    if (find_given(style.radii, text, true) != nullptr) return true;
    const Element* const element = find_element(text);
    return element != nullptr && (table != RadiusTable::ionic || ionic_radius(element->symbol) > 0);
  });
}

bool radius_needs_all(const ParticleFrame& some, const ParticleStyle& style) {
  if (const auto* const table = std::get_if<RadiusTable>(&style.radius))
    return !are_all_listed(some, style, *table);
  if (!std::holds_alternative<std::monostate>(style.radius)) return false;
  if (find_number_column(some, "radius") != nullptr) return false;
  if (find_number_column(some, "diameter") != nullptr) return false;
  return !are_all_listed(some, style, RadiusTable::vdw);
}

bool has_numbers(const ParticleFrame& some, const std::string& name) {
  return find_number_column(some, name) != nullptr;
}

bool color_needs_all(const ParticleFrame& some, const ParticleStyle& style) {
  if (const auto* const mapped = std::get_if<MappedColors>(&style.color))
    return !mapped->range.has_value();
  if (const auto* const columns = std::get_if<ColorColumns>(&style.color)) {
    // A column of texts has a colour for each; numbers may be kinds, or codes to 255.
    const std::string& name = columns->names.front();
    return columns->names.size() != 1 || has_numbers(some, name) ||
           find_particle_texts(some, name) == nullptr;
  }
  if (!std::holds_alternative<std::monostate>(style.color)) return false;
  return has_numbers(some, "red") && has_numbers(some, "green") && has_numbers(some, "blue");
}

bool draws_more_than_spheres(const ParticleStyle& style) {
  const auto* const rule = std::get_if<BondRule>(&style.bonds);
  const bool has_bonds = !std::holds_alternative<std::monostate>(style.bonds) &&
                         !(rule != nullptr && *rule == BondRule::none);
  const bool has_sticks =
      style.shape.value_or(ParticleShape::space_filling) != ParticleShape::space_filling;
  return has_bonds || has_sticks || style.cell_edges || style.axes || style.arrows || style.unwrap;
}

void extend_box(std::array<Vec3d, 2>& box, const std::array<Vec3d, 2>& by) {
  for (double Vec3d::*const axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    box[0].*axis = std::min(box[0].*axis, by[0].*axis);
    box[1].*axis = std::max(box[1].*axis, by[1].*axis);
  }
}

/// Adds the kinds that are shown of another part of the same frame.
void add_counts(const ParticleColors& part, ParticleColors& colors) {
  for (const ParticleColors::Species& one : part.species) {
    const auto found = std::find_if(colors.species.begin(), colors.species.end(),
                                    [&](const auto& known) { return known.name == one.name; });
    if (found == colors.species.end()) {
      colors.species.push_back(one);
    } else {
      found->count += one.count;
    }
  }
  if (!part.scale) return;
  if (!colors.scale) {
    colors.scale = part.scale;
    return;
  }
  colors.scale->missing += part.scale->missing;
  colors.scale->goes_below = colors.scale->goes_below || part.scale->goes_below;
  colors.scale->goes_above = colors.scale->goes_above || part.scale->goes_above;
}

}  // namespace

std::string what_needs_all(const ParticleFrame& some, const ParticleStyle& style) {
  if (style.boundary || style.replicate != std::array<int, 3>{1, 1, 1})
    return "images are those of all particles";
  if (!style.ghost.empty()) return "ghosts are found among all particles";
  if (draws_more_than_spheres(style)) return "bonds and lines are those of all particles";
  const auto* const lines = std::get_if<OutlineRule>(&style.outline_by);
  const bool has_groups = !std::holds_alternative<std::monostate>(style.outline_by) &&
                          (lines == nullptr || *lines != OutlineRule::object);
  if (has_groups) return "groups of outlines are those of all particles";
  if (radius_needs_all(some, style))
    return "the radius is found from all particles (a given one is not)";
  if (color_needs_all(some, style))
    return "what the colours mean is found from all particles (a given range is not)";
  return {};
}

std::size_t PartedSpheres::parts() const {
  return static_cast<std::size_t>((particles() + particles_of_part - 1) / particles_of_part);
}

Result<ParticleFrame> PartedSpheres::frame_of(std::size_t part) {
  const std::uint64_t begin = std::uint64_t{part} * particles_of_part;
  const std::uint64_t count = std::min<std::uint64_t>(particles_of_part, particles() - begin);
  auto read = frame_->read(begin, static_cast<std::size_t>(count));
  if (read) return read;
  const std::string& column = read.error().key;
  return Diagnostic::about(
      "file", (column.empty() ? "" : "column " + quote(column) + " ") + read.error().message);
}

Result<std::unique_ptr<PartedSpheres>> PartedSpheres::make(std::unique_ptr<FrameParts> frame,
                                                           const ParticleStyle& style,
                                                           const ParallelFor& parallel_for) {
  std::unique_ptr<PartedSpheres> made(new PartedSpheres(std::move(frame), style));
  for (std::size_t part = 0; part < made->parts(); ++part) {
    if (auto done = made->add(part, parallel_for); !done) return done.error();
  }
  if (made->colors_.scale && made->colors_.scale->missing > 0)
    made->notes_.push_back(missing_note(*made->colors_.scale));
  return Result<std::unique_ptr<PartedSpheres>>(std::move(made));
}

/// Finds what is told of all parts. The notes are those of the first part that shows something.
Status PartedSpheres::add(std::size_t part, const ParallelFor& parallel_for) {
  auto frame = frame_of(part);
  if (!frame) return frame.error();
  time_ = frame.value().time;
  const auto made = ParticleSpheres::make(std::move(frame).value(), style_, parallel_for);
  if (!made) return made.error();
  const ParticleSpheres& spheres = made.value();
  const bool is_first = size() == 0;
  starts_.push_back(size() + spheres.size());
  if (is_first) {
    bounds_ = spheres.center_bounds();
    smallest_radius_ = spheres.smallest_radius();
    radius_source_ = spheres.radius_source();
    cell_ = spheres.cell();
    axes_matter_ = spheres.axes_matter();
    notes_ = spheres.notes();
    const auto& scale = spheres.colors().scale;
    if (scale && scale->missing > 0) std::erase(notes_, missing_note(*scale));
  } else if (spheres.size() > 0) {
    extend_box(bounds_, spheres.center_bounds());
    smallest_radius_ = std::min(smallest_radius_, spheres.smallest_radius());
  }
  add_counts(spheres.colors(), colors_);
  return {};
}

PartedSpheres::Place PartedSpheres::part_of(std::uint64_t sphere) const {
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), sphere);
  const auto part = static_cast<std::size_t>(next - starts_.begin()) - 1;
  return {part, starts_[part]};
}

Status PartedSpheres::read(std::size_t part, const Vec3d& origin, std::vector<Sphere>& spheres,
                           const ParallelFor& parallel_for) {
  spheres.clear();
  auto frame = frame_of(part);
  if (!frame) return frame.error();
  auto made = ParticleSpheres::make(std::move(frame).value(), style_, parallel_for);
  if (!made) return made.error();
  if (made.value().size() != starts_[part + 1] - starts_[part])
    return Diagnostic::of("the file has changed meanwhile");
  return std::move(made).value().append_to(spheres, origin, parallel_for);
}

}  // namespace boule
