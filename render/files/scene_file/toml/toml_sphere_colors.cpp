#include "render/files/scene_file/toml/toml_sphere_colors.h"

#include <cstddef>
#include <string_view>
#include <vector>

#include "render/files/particles/colors/percentiles.h"
#include "render/files/particles/particle_columns.h"

namespace boule {
namespace {

/// The map and its range: that of the keys, of the series, or of the numbers.
MappedSpheres choose_range(const TomlTable& table, const SphereColors& keys,
                           const std::vector<double>& numbers, const SceneFileOptions& options) {
  MappedSpheres mapped{.scale = {keys.scalar, keys.map.map, {0, 1}}};
  if (keys.map.range) {
    mapped.scale.range = *keys.map.range;
    return mapped;
  }
  const ParticleChoices* const chosen = find_choices(options.choices, table.path());
  const bool of_series = chosen != nullptr && chosen->range;
  if (!of_series && !numbers.empty()) {
    const ParticleNumbers view(numbers.data(), 1);
    mapped.own.range = percentiles(view, numbers.size(), options.parallel_for);
  }
  const auto& ends = of_series ? chosen->range : mapped.own.range;
  if (!ends) return mapped;
  mapped.scale.range = map_range(*ends);
  mapped.note = range_note(keys.written, *ends, of_series ? chosen->of_frames : "");
  return mapped;
}

std::optional<MappedSpheres> map_numbers(TomlTable& table, const SphereColors& keys,
                                         const MaterialRows& materials,
                                         const SceneFileOptions& options) {
  auto numbers = read_npy_scalars(table.file_path(keys.scalar), materials.count, materials.of_each);
  if (!numbers) {
    table.report("scalar", quote(keys.scalar) + ": " + numbers.error().message);
    return std::nullopt;
  }
  MappedSpheres mapped = choose_range(table, keys, numbers.value(), options);
  const RangePlace place(mapped.scale.range);
  for (std::size_t i = 0; i < materials.count; ++i) {
    MaterialRef& material = materials.at(i);
    material =
        MaterialRef::colored(material.index(), keys.map.map.color(place(numbers.value()[i])));
  }
  return mapped;
}

}  // namespace

SphereColors read_sphere_colors(TomlTable& table) {
  SphereColors keys;
  if (table.has("colors")) table.read_file_name("colors", keys.colors);
  keys.space = static_cast<ColorSpace>(table.choose("color_space", names<ColorSpace>));
  if (table.has("scalar")) {
    table.read("scalar", keys.written);
    table.read_file_name("scalar", keys.scalar);
  }
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

std::optional<MappedSpheres> color_spheres(TomlTable& table, const SphereColors& keys,
                                           const MaterialRows& materials,
                                           const SceneFileOptions& options) {
  if (!keys.scalar.empty()) return map_numbers(table, keys, materials, options);
  if (auto done = color_by_npy(table.file_path(keys.colors), keys.space, materials); !done) {
    table.report("colors", quote(keys.colors) + ": " + done.error().message);
  }
  return std::nullopt;
}

}  // namespace boule
