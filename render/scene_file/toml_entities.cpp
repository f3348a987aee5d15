#include "render/scene_file/toml_entities.h"

#include <utility>

#include "core/scene/problem_finder.h"
#include "render/scene_file/picture_file.h"
#include "render/scene_file/toml_fields.h"

namespace boule {
namespace {

/// Finishes the table and checks what came of it.
template <class Kind>
void read_entity(TomlTable& table, Kind& kind) {
  read_fields(table, kind);
  table.finish();
  table.check(first_problem(kind));
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
    table.report(problem->field, (of_file ? quote(name) + ": " : "") + problem->message);
  }
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

}  // namespace boule
