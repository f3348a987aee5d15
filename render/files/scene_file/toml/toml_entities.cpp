#include "render/files/scene_file/toml/toml_entities.h"

#include <string>
#include <utility>

#include "core/scene/problem_finder.h"
#include "render/files/scene_file/toml/picture_file.h"
#include "render/files/scene_file/toml/toml_fields.h"

namespace boule {
namespace {

/// Finishes the table and checks what came of it.
template <class Kind>
void read_entity(TomlTable& table, Kind& kind) {
  read_fields(table, kind);
  table.finish();
  table.check(first_problem(kind));
}

/// Nothing in a picture tells which map of directions it is, but its shape may tell that it is not
/// the one that is expected. One pixel is the same in any.
void note_shape(TomlTable& table, const std::string& name, const EnvironmentBackground& image) {
  const double ratio = static_cast<double>(image.width) / image.height;
  if ((ratio > 1.9 && ratio < 2.1) || image.pixels.size() == 1) return;
  table.note("file", quote(name) + " has " + std::to_string(image.width) + " x " +
                         std::to_string(image.height) +
                         " pixels and is taken as latitude-longitude, which is twice as wide as "
                         "high: convert light probes and cube maps first");
}

/// Reads the file only if all keys are right.
void read_entity(TomlTable& table, EnvironmentBackground& background) {
  std::string name;
  table.read_file_name("file", name);
  read_fields(table, background);
  table.finish({"file"});
  if (!table.ok()) return;
  auto image = read_picture(table, name, PictureContent::colors);
  if (!image) {
    return table.report("file", quote(name) + ": " + image.error().message);
  }
  background.width = image.value().width;
  background.height = image.value().height;
  background.pixels = std::move(image).value().pixels;
  if (const auto problem = first_problem(background)) {
    const bool of_file = problem->field == "file";
    return table.report(problem->field, (of_file ? quote(name) + ": " : "") + problem->message);
  }
  note_shape(table, name, background);
}

}  // namespace

ImageSettings read_image_settings(TomlTable& table) {
  ImageSettings image;
  read_fields(table, image);
  table.finish();
  return image;
}

RenderSettings read_render(TomlTable& table) {
  RenderSettings render;
  read_fields(table, render);
  table.finish();
  return render;
}

Background read_background(TomlTable& table, Scene& scene) {
  return read_kind<Background>(table, [&](auto& from, auto& kind) {
    from.read("ambient", scene.ambient);
    if (from.has("backdrop")) from.read("backdrop", scene.backdrop.emplace());
    read_entity(from, kind);
  });
}

Material read_material(TomlTable& table) {
  return read_kind<Material>(table, [](auto& from, auto& kind) { read_entity(from, kind); });
}

Light read_light(TomlTable& table) {
  std::string frame;
  table.read("relative_to", frame);
  if (frame == name_of(LightFrame::camera)) table.set_origin(nullptr);
  return read_kind<Light>(table, [](auto& from, auto& kind) { read_entity(from, kind); });
}

Clip read_clip(TomlTable& table) {
  Clip clip;
  read_entity(table, clip);
  return clip;
}

}  // namespace boule
