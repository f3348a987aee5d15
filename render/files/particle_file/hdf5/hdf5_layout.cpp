#include "render/files/particle_file/hdf5/hdf5_layout.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/base/text.h"
#include "core/math/geometry.h"

namespace boule {

std::vector<std::string> hdf5_column_names(const std::string& name, std::uint64_t width) {
  if (width == 1) return {name};
  std::vector<std::string> names;
  if (width != 3) {
    for (std::uint64_t i = 1; i <= width; ++i) names.push_back(name + "_" + std::to_string(i));
    return names;
  }
  const std::string small = ascii_lower(std::string_view(name));
  const auto velocities = {"v", "vel", "velo", "velocity", "velocities"};
  const bool is_velocity = std::count(velocities.begin(), velocities.end(), small) > 0;
  for (const char* const axis : {"x", "y", "z"})
    names.push_back((is_velocity ? "v" : name + "_") + axis);
  return names;
}

void add_array(Hdf5Array array, const ParticleFileOptions& options, Hdf5Layout& layout) {
  const bool is_asked =
      std::any_of(array.names.begin(), array.names.end(),
                  [&](const std::string& name) { return is_wanted(options.wanted, name); });
  if (is_asked) return layout.arrays.push_back(std::move(array));
  auto& unread = layout.facts.unread;
  unread.insert(unread.end(), array.names.begin(), array.names.end());
}

void leave_out(const std::string& name, const std::string& why, Hdf5Layout& layout) {
  layout.facts.unread.push_back(name);
  layout.facts.notes.push_back(quote(name) + " is left out: " + why);
}

void set_cell(const std::array<Vec3d, 3>& edges, const std::array<bool, 3>& periodic,
              ParticleFrame& frame) {
  const auto& [a, b, c] = edges;
  const double volume = dot(a, cross(b, c));
  if (!(volume != 0)) return;
  frame.cell = ParticleCell{.a = a, .b = b, .c = c, .periodic = periodic};
}

}  // namespace boule
