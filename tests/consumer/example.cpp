// Boule as a library: a scene in memory, rays in and hits out, and the same scene as a picture.
#include <boule/boule.h>

#include <cstdio>

int fail(const boule::Diagnostic& diagnostic) {
  std::fprintf(stderr, "%s\n", boule::format_diagnostic(diagnostic).c_str());
  return 1;
}

int main() {
  boule::Scene scene;
  scene.materials = {{"red", boule::Plastic{{0.8f, 0.1f, 0.1f}}}, {"white", boule::Matte{}}};
  scene.spheres = {{{0, 1, 0}, 1, 0}};         // centre, radius, material: id 0
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 1}};  // point, normal, material: id 1
  scene.lights = {boule::PointLight{{4, 6, 4}}};
  scene.camera = boule::PinholeCamera{{{0, 1.5f, 6}, {0, 1, 0}}};  // eye, look_at
  scene.image = {160, 90, 4};  // width, height, samples per pixel

  // Rays in, hits out, on the widest instruction set of this machine.
  const auto kernels = boule::select_kernels("auto");
  if (!kernels) return fail(kernels.error());
  const boule::Geometry geometry(scene.spheres, scene.planes);
  boule::RayBuffer rays(3);
  boule::HitBuffer hits(rays.size());
  rays.set(0, {{0, 1, 6}, {0, 0, -1}});  // origin, direction
  rays.set(1, {{3, 2, 0}, {0, -4, 0}});
  rays.set(2, {{3, 2, 0}, {0, 1, 0}});
  kernels.value()->closest_hit(geometry.view(), rays.view(), boule::Query{}, hits.view());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    std::printf("ray %zu: primitive %d at t = %g\n", i, hits.get(i).id, hits.get(i).t);
  }

  // The same scene as a picture.
  auto renderer = boule::Renderer::create(scene, boule::options_of(scene));
  if (!renderer) return fail(renderer.error());
  const auto image = renderer.value().render();
  if (!image) return fail(image.error());
  if (auto done = boule::write_image(image.value(), "example.jpg"); !done)
    return fail(done.error());
}
