#include "render/files/particles/particle_spheres.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/chunks.h"
#include "core/base/float_environment.h"
#include "core/base/memory_pages.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"
#include "render/files/file/sphere_room.h"
#include "render/files/particles/colors/particle_colors.h"
#include "render/files/particles/ghost_materials.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/particle_radii.h"
#include "render/files/particles/select/particle_select.h"
#include "render/files/particles/select/select_expression.h"
#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"

namespace boule {
namespace {

/// The product of the counts, or the first number above the most spheres if it is larger.
std::uint64_t count_images(const std::array<int, 3>& counts) {
  std::uint64_t images = 1;
  for (const int count : counts) {
    images = std::min<std::uint64_t>(images * static_cast<std::uint64_t>(count),
                                     max_shown_primitives + 1);
  }
  return images;
}

Status check_cell(const ParticleFrame& frame, const ParticleStyle& style,
                  std::vector<std::string>& notes) {
  const bool replicates = count_images(style.replicate) > 1;
  if (!frame.cell) {
    if (style.wrap) return Diagnostic::about("wrap", "the file tells no cell to wrap into");
    if (style.unwrap) return Diagnostic::about("unwrap", "the file tells no cell");
    if (style.boundary) return Diagnostic::about("boundary", "the file tells no cell with faces");
    if (style.cell_edges) return Diagnostic::about("cell_edges", "the file tells no cell to draw");
    if (replicates) return Diagnostic::about("replicate", "the file tells no cell to replicate");
    return {};
  }
  const ParticleCell& cell = *frame.cell;
  const std::array<Vec3d, 3> vectors{cell.a, cell.b, cell.c};
  for (std::size_t k = 0; k < 3; ++k) {
    if (style.replicate[k] == 1) continue;
    const std::string name(1, "abc"[k]);
    if (vectors[k] == Vec3d{}) {
      return Diagnostic::about("replicate", "the file's cell has no vector " + name);
    }
    if (!cell.periodic[k]) {
      notes.push_back("the file's cell is not periodic along " + name +
                      ", but is replicated along it");
    }
  }
  if (cell.periodic == std::array<bool, 3>{}) {
    const std::string why = "the file's cell is not periodic, so ";
    if (style.wrap) notes.push_back(why + "nothing is wrapped into it");
    if (style.unwrap) notes.push_back(why + "molecules stay as they are");
    if (style.boundary) notes.push_back(why + "nothing is repeated on its faces");
  }
  return {};
}

Status check_style(const ParticleStyle& style) {
  if (!(style.scale > 0) || !std::isfinite(style.scale)) {
    return Diagnostic::about("scale", "expected a finite number above 0");
  }
  for (const int count : style.replicate) {
    if (count < 1) return Diagnostic::about("replicate", "expected three numbers from 1 on");
  }
  return {};
}

/// So many images of so many particles are shown as instances of one group. The centres of fewer
/// are rounded once, those of these twice: in the group, and where it is shown.
bool are_shared(std::uint64_t images, std::uint64_t particles, std::uint64_t fewest_spheres) {
  constexpr std::uint64_t fewest_images = 4, fewest_particles = 128;
  return images >= fewest_images && particles >= fewest_particles &&
         images >= (fewest_spheres + particles - 1) / particles;
}

/// Whether the spheres, and what is kept to make them, fit into memory and ids.
Status check_room(std::size_t particles, const ParticleStyle& style) {
  const std::uint64_t images = count_images(style.replicate);
  const std::string key = images > 1 ? "replicate" : "file";
  const bool shared = are_shared(images, particles, ParticleSpheres::fewest_shared);
  const std::uint64_t most = shared ? max_shown_primitives : max_primitives;
  if (particles > 0 && images > most / particles)
    return Diagnostic::about(key, "more than " + std::to_string(most) + " spheres");
  constexpr std::uint64_t kept = sizeof(float) + sizeof(MaterialRef);
  const std::uint64_t spheres = shared ? particles : images * particles;
  const std::uint64_t instances = shared ? images : 0;
  return check_memory(bytes_of_spheres(spheres) + kept * particles + instances * sizeof(Instance),
                      std::to_string(spheres) + " spheres need", key);
}

/// The place in a frame of the particle that is at `shown` among those that are selected.
std::size_t place_of(std::size_t shown, const std::vector<std::uint8_t>& selected) {
  if (selected.empty()) return shown;
  for (std::size_t i = 0; i < selected.size(); ++i) {
    if (selected[i] != 0 && shown-- == 0) return i;
  }
  return selected.size();
}

void extend(std::array<Vec3d, 2>& box, const Vec3d& point) {
  for (double Vec3d::*const axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    box[0].*axis = std::min(box[0].*axis, point.*axis);
    box[1].*axis = std::max(box[1].*axis, point.*axis);
  }
}

std::array<Vec3d, 2> bounds_of(const std::vector<Vec3d>& positions,
                               const ParallelFor& parallel_for) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::array<Vec3d, 2> empty{Vec3d{inf, inf, inf}, Vec3d{-inf, -inf, -inf}};
  std::vector<std::array<Vec3d, 2>> boxes(chunks_of(positions.size()), empty);
  in_chunks(parallel_for, positions.size(),
            [&](std::size_t chunk, std::size_t begin, std::size_t end) {
              std::array<Vec3d, 2> box = empty;
              for (std::size_t i = begin; i < end; ++i) extend(box, positions[i]);
              boxes[chunk] = box;
            });
  if (boxes.empty()) return {};
  std::array<Vec3d, 2> all = empty;
  for (const auto& box : boxes) {
    extend(all, box[0]);
    extend(all, box[1]);
  }
  return all;
}

/// The box of all images of a box: each shift is that of a corner of the images' own box.
std::array<Vec3d, 2> bounds_of_images(const std::array<Vec3d, 2>& box, const ParticleCell& cell,
                                      const std::array<int, 3>& counts) {
  std::array<Vec3d, 2> all = box;
  const std::array<Vec3d, 3> vectors{cell.a, cell.b, cell.c};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d farthest = vectors[k] * static_cast<double>(counts[k] - 1);
    for (double Vec3d::*const axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      all[farthest.*axis < 0 ? 0 : 1].*axis += farthest.*axis;
    }
  }
  return all;
}

void append(std::vector<std::string>& notes, std::vector<std::string> more) {
  std::move(more.begin(), more.end(), std::back_inserter(notes));
}

/// The frame without the particles that are not selected; returns which were, or nothing for all.
Result<std::vector<std::uint8_t>> apply_select(ParticleFrame& frame, const ParticleStyle& style,
                                               const ParallelFor& parallel_for) {
  const std::string& select = style.select;
  if (select.empty()) return std::vector<std::uint8_t>();
  if (frame.size() == 0) {
    const auto expression = parse_select(select, "select");
    if (!expression) return expression.error();
    return std::vector<std::uint8_t>();
  }
  if (auto done = check_memory(frame.size(), "selecting particles needs", "select"); !done)
    return done.error();
  const std::size_t count = frame.size();
  auto selected = select_particles(frame, select, parallel_for);
  if (!selected) return selected;
  keep_particles(frame, selected.value(), parallel_for);
  if (frame.positions.empty()) {
    frame.notes.push_back(style.chosen != nullptr  // a series tells it once
                              ? "in some frames no particle meets the selection"
                              : "none of " + std::to_string(count) +
                                    " particles meets the selection");
  }
  return selected;
}

/// Ends the use of columns that none of the values look into.
void drop_columns(ParticleFrame& frame, const ParticleValues<float>& radii,
                  const ParticleValues<MaterialRef>& materials) {
  frame.numbers = {};
  const auto drop = [&](TextColumn& column) {
    if (&column != radii.kinds && &column != materials.kinds) column.indices = {};
  };
  for (TextColumn& column : frame.texts) drop(column);
  if (frame.species) drop(*frame.species);
}

/// How many spheres are made before the memory of their particles goes back: whole chunks, and few
/// beside the rest.
std::size_t portion_of(std::size_t count) {
  constexpr std::size_t least = 4, share = 64;
  return std::max(least, chunks_of(count / share)) * chunk_size;
}

template <class T>
void let_go_of(std::vector<T>& values, std::size_t begin, std::size_t end) {
  if (end <= values.size()) release_pages(values.data() + begin, (end - begin) * sizeof(T));
}

}  // namespace

Result<ParticleSpheres> ParticleSpheres::make(ParticleFrame read, const ParticleStyle& style,
                                              const ParallelFor& parallel_for) {
  const FloatEnvironment environment;
  ParticleSpheres made;
  made.frame_ = std::make_unique<ParticleFrame>(std::move(read));
  ParticleFrame& frame = *made.frame_;
  const std::size_t count = frame.size();
  if (auto done = check_style(style); !done) return done.error();
  if (auto done = check_cell(frame, style, frame.notes); !done) return done.error();
  const auto plan = plan_bonds(frame, style, made.own_);
  if (!plan) return plan.error();
  auto source = find_radius_source(frame, style, plan.value().shape, made.own_, parallel_for);
  // A frame without particles may lack the columns that the others of its series have.
  if (!source && count == 0) source = RadiusSource{.all = 1};
  if (!source) return source.error();
  auto selected = apply_select(frame, style, parallel_for);
  if (!selected) return selected.error();
  if (auto done = check_room(frame.size(), style); !done) return done.error();
  const ParticleNamer name_of = [&](std::size_t shown) {
    return particle_text(place_of(shown, selected.value()), count, frame.part);
  };
  make_kinds(frame, style, made.own_);
  auto radii = make_radii(frame, source.value(), style.scale, name_of, parallel_for);
  if (!radii) return radii.error();
  auto materials = make_materials(frame, style, name_of, parallel_for);
  if (!materials && count == 0) materials = ParticleMaterials{};
  if (!materials) return materials.error();
  made.keep_own(std::move(materials.value().own));
  made.own_.given = style.colors;
  made.own_.nan_color = style.nan_color;
  if (auto done = made.wrap(style, parallel_for); !done) return done.error();
  made.radii_ = std::move(radii.value().radii);
  made.smallest_radius_ = radii.value().smallest;
  made.materials_ = std::move(materials.value().materials);
  if (auto done = make_ghosts(frame, style, made.materials_, parallel_for); !done)
    return done.error();
  if (auto done = made.add_bonds(style, plan.value(), source.value(), name_of, parallel_for); !done)
    return done.error();
  if (auto done = made.add_groups(style, plan.value(), parallel_for); !done) return done.error();
  if (auto done = made.find_bounds(style, parallel_for); !done) return done.error();
  if (auto done = made.add_arrows(style); !done) return done.error();
  made.add_axes(style);
  auto labels = find_labels(frame, style.labels, made.radii_, parallel_for);
  if (!labels) return labels.error();
  made.labels_ = std::move(labels).value();
  made.colors_ = std::move(materials.value().colors);
  made.radius_source_ = std::move(source.value().text);
  append(frame.notes, std::move(source.value().notes));
  append(frame.notes, std::move(materials.value().notes));
  drop_columns(frame, made.radii_, made.materials_);
  return made;
}

/// Adds what the colours depend on to what the radii do.
void ParticleSpheres::keep_own(ParticleChoices colors) {
  if (colors.range) own_.range = colors.range;
  if (own_.column.empty()) own_.kinds = std::move(colors.kinds);
  own_.are_species = colors.are_species;
  own_.all = colors.all;
}

bool ParticleSpheres::shares_images(std::uint64_t fewest_spheres) const {
  return are_shared(images_.size(), frame_->size(), fewest_spheres);
}

/// Wraps the positions into the cell, and finds its images.
Status ParticleSpheres::wrap(const ParticleStyle& style, const ParallelFor& parallel_for) {
  if (count_images(style.replicate) > 1) images_ = CellImages(*frame_->cell, style.replicate);
  if (!style.wrap) return {};
  return wrap_into(*frame_->cell, frame_->positions, parallel_for);
}

/// Finds what is repeated on faces, and the bounds of all images.
Status ParticleSpheres::find_bounds(const ParticleStyle& style, const ParallelFor& parallel_for) {
  const std::vector<Vec3d>& positions = frame_->positions;
  bounds_ = bounds_of(positions, parallel_for);
  if (images_.size() > 1 && !positions.empty())
    bounds_ = bounds_of_images(bounds_, *frame_->cell, style.replicate);
  if (!style.boundary) return {};
  auto boundary = BoundaryImages::find(*frame_->cell, style.replicate, positions, parallel_for);
  if (!boundary) return boundary.error();
  boundary_ = std::move(boundary).value();
  const CellImages places(*frame_->cell, style.replicate);
  boundary_.each([&](std::size_t particle, const ImagePlace& place) {
    extend(bounds_, positions[particle] + places.shift(place));
  });
  return {};
}

/// Gives the memory of particles begin .. end - 1 back.
void ParticleSpheres::let_go(std::size_t begin, std::size_t end) {
  let_go_of(frame_->positions, begin, end);
  if (radii_.kinds == nullptr) let_go_of(radii_.values, begin, end);
  if (materials_.kinds == nullptr) let_go_of(materials_.values, begin, end);
  for (TextColumn& column : frame_->texts) let_go_of(column.indices, begin, end);
  if (frame_->species) let_go_of(frame_->species->indices, begin, end);
}

Status ParticleSpheres::append_to(std::vector<Sphere>& spheres, const Vec3d& origin,
                                  const ParallelFor& parallel_for) && {
  std::vector<Sphere> on_faces;
  if (auto done = append_boundary_to(on_faces, origin); !done) return done;
  if (auto done = append_images_to(spheres, images_.size(), origin, parallel_for); !done)
    return done;
  spheres.insert(spheres.end(), on_faces.begin(), on_faces.end());
  return {};
}

Status ParticleSpheres::append_boundary_to(std::vector<Sphere>& spheres,
                                           const Vec3d& origin) const {
  const FloatEnvironment environment;
  const std::size_t first = spheres.size();
  const CellImages places(frame_->cell.value_or(ParticleCell()), images_.counts());
  boundary_.each([&](std::size_t i, const ImagePlace& place) {
    const Vec3d center = (frame_->positions[i] - origin) + places.shift(place);
    spheres.push_back({vec_cast<float>(center), radii_[i], materials_[i]});
  });
  if (std::all_of(spheres.begin() + static_cast<std::ptrdiff_t>(first), spheres.end(),
                  [](const Sphere& one) { return is_valid(one); })) {
    return {};
  }
  spheres.resize(first);
  return Diagnostic::about("boundary", "an image is too far from the origin for a sphere");
}

Status ParticleSpheres::append_first_image_to(std::vector<Sphere>& spheres, const Vec3d& origin,
                                              const ParallelFor& parallel_for) && {
  return append_images_to(spheres, 1, origin, parallel_for);
}

/// Appends the spheres of the first images, and lets the particles go.
Status ParticleSpheres::append_images_to(std::vector<Sphere>& spheres, std::size_t images,
                                         const Vec3d& origin, const ParallelFor& parallel_for) {
  const FloatEnvironment environment;
  const std::size_t count = frame_->size() * images;
  const std::string key = images_.size() > 1 ? "replicate" : "file";
  if (auto done =
          check_memory(bytes_of_spheres(count), std::to_string(count) + " spheres need", key);
      !done) {
    return done;
  }
  const std::size_t first = spheres.size(), particles = frame_->size();
  make_room(spheres, count);
  std::size_t wrong = no_particle;
  for (std::size_t begin = 0; begin < count;) {
    const std::size_t end = std::min(begin + portion_of(count), count);
    append_blank(spheres, end - begin, parallel_for);
    wrong =
        std::min(wrong, make_spheres({begin, end}, origin, spheres.data() + first, parallel_for));
    const std::size_t last_image = count - particles;
    if (end > last_image) let_go(std::max(begin, last_image) - last_image, end - last_image);
    begin = end;
  }
  if (wrong == no_particle) return {};
  spheres.resize(first);
  return Diagnostic::about(key, "the position of " + particle_text(wrong, particles, frame_->part) +
                                    " is too far from the origin for a sphere");
}

/// Sets some of the spheres. Returns the first particle whose centre is too large, or no_particle.
std::size_t ParticleSpheres::make_spheres(const Range& range, const Vec3d& origin, Sphere* spheres,
                                          const ParallelFor& parallel_for) const {
  const std::vector<Vec3d>& positions = frame_->positions;
  const std::size_t count = range.end - range.begin;
  std::vector<std::size_t> wrong(chunks_of(count), no_particle);
  in_chunks(parallel_for, count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const std::size_t start = range.begin + begin;
    std::size_t image = start / positions.size(), i = start % positions.size();
    Vec3d shift = images_.shift(image);
    for (std::size_t n = start; n < range.begin + end; ++n, ++i) {
      if (i == positions.size()) {
        i = 0;
        shift = images_.shift(++image);
      }
      // The shift last: what is far from zero has no digits left for it.
      const Vec3d center = (positions[i] - origin) + shift;
      spheres[n] = {vec_cast<float>(center), radii_[i], materials_[i]};
      if (!is_valid(spheres[n])) wrong[chunk] = std::min(wrong[chunk], i);
    }
  });
  return *std::min_element(wrong.begin(), wrong.end());
}

}  // namespace boule
