#include "render/scene_file/toml_entities.h"

#include <utility>

#include "render/scene_file/picture_file.h"

namespace boule {
namespace {

ConstantBackground read_constant(TomlTable& table) {
  ConstantBackground background;
  table.read("color", background.color);
  return background;
}

/// Finishes the table: the file is read where all else is right.
EnvironmentBackground read_environment(TomlTable& table) {
  EnvironmentBackground background;
  std::string name;
  table.read_file_name("file", name);
  table.read("rotation", background.rotation);
  table.finish({"file"});
  if (!table.ok()) return background;
  auto image = read_picture(table.file_path(name), PictureContent::colors);
  if (!image) {
    table.report("file", quote(name) + ": " + image.error().message);
    return background;
  }
  background.width = image.value().width;
  background.height = image.value().height;
  background.pixels = std::move(image).value().pixels;
  if (const auto problem = find_problem(Background{background})) {
    const bool of_file = problem->field == "file";
    table.report(problem->field, (of_file ? quote(name) + ": " : "") + problem->message);
  }
  return background;
}

GradientBackground read_gradient(TomlTable& table) {
  GradientBackground background;
  table.read("bottom", background.bottom);
  table.read("top", background.top);
  table.read("up", background.up);
  return background;
}

void read_keys(TomlTable& table, Matte& matte) { table.read("color", matte.color); }

void read_keys(TomlTable& table, Plastic& plastic) {
  table.read("color", plastic.color);
  table.read("specular", plastic.specular);
  table.read("shininess", plastic.shininess);
  table.read("reflect", plastic.reflect);
}

void read_keys(TomlTable& table, Metal& metal) { table.read("color", metal.color); }

void read_keys(TomlTable& table, Glass& glass) {
  table.read("color", glass.color);
  table.read("ior", glass.ior);
}

void read_keys(TomlTable& table, Emissive& emissive) { table.read("radiance", emissive.radiance); }

void read_keys(TomlTable& table, Phong& phong) {
  table.read("color", phong.color);
  table.read("ka", phong.ka);
  table.read("kd", phong.kd);
  table.read("ks", phong.ks);
  table.read("shininess", phong.shininess);
  table.read("transmission", phong.transmission);
  table.read("ior", phong.ior);
}

PointLight read_point(TomlTable& table) {
  constexpr Falloff falloffs[] = {Falloff::none, Falloff::inverse_square};
  PointLight light;
  table.read("position", light.position);
  table.read("intensity", light.intensity);
  light.falloff = falloffs[table.choose("falloff", {"none", "inverse_square"})];
  return light;
}

SphereLight read_sphere_light(TomlTable& table) {
  SphereLight light;
  table.read("center", light.center);
  table.read("radius", light.radius);
  table.read("radiance", light.radiance);
  return light;
}

DirectionalLight read_directional(TomlTable& table) {
  DirectionalLight light;
  table.read("direction", light.direction);
  table.read("intensity", light.intensity);
  return light;
}

}  // namespace

ImageSettings read_image(TomlTable& table) {
  constexpr PixelFilter filters[] = {PixelFilter::box, PixelFilter::tent};
  ImageSettings image;
  table.read("size", image.width, image.height);
  table.read("spp", image.spp);
  image.filter = filters[table.choose("filter", {"box", "tent"})];
  table.finish();
  return image;
}

RenderSettings read_render(TomlTable& table) {
  constexpr Method methods[] = {Method::whitted, Method::path};
  RenderSettings render;
  render.method = methods[table.choose("method", {"whitted", "path"})];
  table.read("max_depth", render.max_depth);
  table.finish();
  return render;
}

Background read_background(TomlTable& table, Color& ambient) {
  Background background;
  const std::size_t type = table.choose("type", {"constant", "gradient", "environment"});
  table.read("ambient", ambient);
  if (type == 2) return read_environment(table);
  if (type == 0) {
    background = read_constant(table);
  } else {
    background = read_gradient(table);
  }
  table.finish();
  table.check(find_problem(background));
  return background;
}

Material read_material(TomlTable& table) {
  Material kinds[] = {Matte{}, Plastic{}, Metal{}, Glass{}, Emissive{}, Phong{}};
  Material& material =
      kinds[table.choose("type", {"matte", "plastic", "metal", "glass", "emissive", "phong"})];
  std::visit([&](auto& kind) { read_keys(table, kind); }, material);
  table.finish();
  table.check(find_problem(material));
  return material;
}

Light read_light(TomlTable& table) {
  Light light;
  switch (table.choose("type", {"point", "directional", "sphere"})) {
    case 0:
      light = read_point(table);
      break;
    case 1:
      light = read_directional(table);
      break;
    default:
      light = read_sphere_light(table);
  }
  table.finish();
  table.check(find_problem(light));
  return light;
}

}  // namespace boule
