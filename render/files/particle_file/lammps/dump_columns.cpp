#include "render/files/particle_file/lammps/dump_columns.h"

#include <algorithm>
#include <cstddef>

#include "core/math/geometry.h"
#include "render/files/particle_file/lammps/id_order.h"
#include "render/files/particle_file/text/text_lines.h"

namespace boule {
namespace {

bool is_upright(const ParticleCell& cell) {
  return cell.a.y == 0 && cell.a.z == 0 && cell.b.x == 0 && cell.b.z == 0 && cell.c.x == 0 &&
         cell.c.y == 0;
}

}  // namespace

DumpColumns::DumpColumns(const std::vector<std::string>& names,
                         std::span<const std::string_view> examples,
                         const ParticleFileOptions& options, ParticleFrame& read)
    : read_(read), columns_(options.wanted, read) {
  find_positions(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto axis = std::find(names_.begin(), names_.end(), names[i]);
    if (axis != names_.end()) {
      columns_.add_position(names[i], static_cast<std::size_t>(axis - names_.begin()));
    } else {
      columns_.add(names[i], examples, i);
    }
  }
}

void DumpColumns::find_positions(const std::vector<std::string>& names) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    names_[axis] = std::string(1, static_cast<char>('x' + axis));
    for (const char* suffix : {"", "s", "u", "su"}) {
      const std::string name = static_cast<char>('x' + axis) + std::string(suffix);
      if (std::count(names.begin(), names.end(), name) == 0) continue;
      names_[axis] = name;
      scaled_[axis] = *suffix == 's';
      break;
    }
  }
}

Status DumpColumns::check(std::uint64_t names_line) const {
  if (auto done = columns_.check_positions(); !done) {
    return error_at_line(names_line, done.error().message, done.error().key);
  }
  if (!any_scaled()) return {};
  auto done = check_scaled();
  return done ? done : error_at_line(names_line, done.error().message, done.error().key);
}

Status DumpColumns::check_scaled() const {
  if (!read_.cell) {
    return Diagnostic::about("BOX BOUNDS",
                             "its positions are fractions of a box, which it does not have");
  }
  if (all_scaled() || is_upright(*read_.cell)) return {};
  return Diagnostic::about(names_[0],
                           "in a tilted box, all of x, y and z must be fractions of it, or none");
}

Status DumpColumns::finish(std::uint64_t first_line, const ParallelFor& parallel_for) {
  if (any_scaled()) {
    unscale();
    // Fractions of a huge box may be beyond the largest number.
    const auto beyond = std::find_if(read_.positions.begin(), read_.positions.end(),
                                     [](const Vec3d& p) { return !is_finite(p); });
    if (beyond != read_.positions.end()) {
      return error_at_row(first_line, static_cast<std::uint64_t>(beyond - read_.positions.begin()),
                          "its position in the box is too large a number");
    }
  }
  if (auto done = sort_by_id(read_, first_line, parallel_for); !done) return done;
  columns_.finish();
  return {};
}

/// Makes positions of fractions of the cell.
void DumpColumns::unscale() {
  const Vec3d o = read_.cell->origin, a = read_.cell->a, b = read_.cell->b, c = read_.cell->c;
  if (all_scaled()) {
    for (Vec3d& p : read_.positions) p = o + a * p.x + b * p.y + c * p.z;
    return;
  }
  for (Vec3d& p : read_.positions) {
    if (scaled_[0]) p.x = o.x + a.x * p.x;
    if (scaled_[1]) p.y = o.y + b.y * p.y;
    if (scaled_[2]) p.z = o.z + c.z * p.z;
  }
}

Status DumpColumns::read(const TextRows& rows, std::uint64_t names_line,
                         const ParallelFor& parallel_for) {
  if (auto done = check(names_line); !done) return done;
  if (auto done = read_text_rows(rows, columns(), read_, parallel_for); !done) return done;
  return finish(rows.first_line, parallel_for);
}

}  // namespace boule
