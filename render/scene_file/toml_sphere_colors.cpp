#include "render/scene_file/toml_sphere_colors.h"

#include <cstddef>
#include <string_view>
#include <vector>

#include "render/particles/particle_columns.h"
#include "render/particles/percentiles.h"

namespace boule {
namespace {

/// From the 1st to the 99th percentile of the numbers.
std::array<double, 2> usual_range(const std::vector<double>& numbers,
                                  const ParallelFor& parallel_for) {
  if (numbers.empty()) return {0, 1};
  return percentiles(ParticleNumbers(numbers.data(), 1), numbers.size(), parallel_for);
}

std::optional<ParticleColors::Scale> map_numbers(TomlTable& table, const SphereColors& keys,
                                                 std::span<Sphere> spheres,
                                                 const SceneFileOptions& options) {
  auto numbers = read_npy_scalars(table.file_path(keys.scalar), spheres.size());
  if (!numbers) {
    table.report("scalar", quote(keys.scalar) + ": " + numbers.error().message);
    return std::nullopt;
  }
  const auto known = options.color_ranges.find(table.path());
  const auto range = keys.map.range ? *keys.map.range
                     : known != options.color_ranges.end()
                         ? known->second
                         : usual_range(numbers.value(), options.parallel_for);
  const RangePlace place(range);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    MaterialRef& material = spheres[i].material;
    material =
        MaterialRef::colored(material.index(), keys.map.map.color(place(numbers.value()[i])));
  }
  return ParticleColors::Scale{keys.scalar, keys.map.map, range};
}

}  // namespace

SphereColors read_sphere_colors(TomlTable& table) {
  SphereColors keys;
  if (table.has("colors")) table.read_file_name("colors", keys.colors);
  keys.space = static_cast<ColorSpace>(table.choose("color_space", names<ColorSpace>));
  if (table.has("scalar")) table.read_file_name("scalar", keys.scalar);
  keys.map = read_color_map(table);
  for (const char* key : {"colors", "scalar"}) {
    if (!table.has(key)) continue;
    if (table.has("color")) table.report(key, "cannot stand beside 'color'");
    if ((key == std::string_view("colors") ? keys.colors : keys.scalar).empty()) {
      table.report(key, "expected the name of a .npy file");
    }
  }
  if (table.has("scalar") && table.has("colors")) {
    table.report("scalar", "cannot stand beside 'colors'");
  }
  if (table.has("color_space") && !table.has("colors")) {
    table.report("color_space", "goes with 'colors', which is missing");
  }
  for (const char* key : {"map", "range"}) {
    if (table.has(key) && !table.has("scalar")) {
      table.report(key, "goes with 'scalar', which is missing");
    }
  }
  return keys;
}

std::optional<ParticleColors::Scale> color_spheres(TomlTable& table, const SphereColors& keys,
                                                   std::span<Sphere> spheres,
                                                   const SceneFileOptions& options) {
  if (!keys.scalar.empty()) return map_numbers(table, keys, spheres, options);
  if (auto bad = color_by_npy(table.file_path(keys.colors), keys.space, spheres)) {
    table.report("colors", quote(keys.colors) + ": " + bad->message);
  }
  return std::nullopt;
}

}  // namespace boule
