#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "render/apps/job/options/render_choices.h"
#include "render/apps/python/scenes/scenes.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/field_values.h"
#include "render/apps/python/values/job_arguments.h"
#include "render/apps/python/values/presence.h"
#include "render/memory/available_memory.h"
#include "render/prepare/prepared_scene.h"
#include "render/renderer/picture_rays.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// The rays of a picture in memory.
struct RayArrays {
  py::ssize_t height = 0, width = 0;
  std::vector<Vec3d> org;
  std::vector<Vec3f> dir;
};

RenderJob picture_job(const Arguments& given) {
  RenderJob job;
  read_rows(given, render_choices(), job);
  return job;
}

Status find(LoadedScene loaded, const RenderOptions& options, int sample, Call& call,
            RayArrays& to) {
  const PixelRect rect = rendered_rect(options);
  const auto rays = static_cast<std::size_t>(rect.area());
  if (auto done = check_memory(rays * (sizeof(Vec3d) + sizeof(Vec3f)), "the rays need"); !done)
    return done;
  to = {rect.height(), rect.width(), std::vector<Vec3d>(rays), std::vector<Vec3f>(rays)};
  const Vec3d zero = loaded.origin;
  auto done = find_picture_rays(std::move(loaded.scene), options, sample,
                                {to.org.data(), to.dir.data()}, call.parallel_for());
  if (!(zero == Vec3d{})) {
    for (Vec3d& org : to.org) org = org + zero;
  }
  return done;
}

/// Origins and directions, H x W x 3 each.
py::tuple camera_rays(const py::object& source, const py::dict& keys, const py::dict& options) {
  const SceneRequest request(source, keys);
  const Arguments given(options);
  const RenderJob job = picture_job(given);
  const int sample =
      static_cast<int>(*given.whole("sample", {.low = 0, .high = std::numeric_limits<int>::max()}));
  const auto rays = std::make_shared<RayArrays>();
  check(interruptible([=](Call& call) -> Status {
    auto loaded = request.load(call);
    if (!loaded) return loaded.error();
    const RenderOptions of_picture = options_of(job, loaded.value().scene);
    if (auto done = validate(of_picture); !done) return done;
    return find(std::move(loaded).value(), of_picture, sample, call, *rays);
  }));
  const std::vector<py::ssize_t> shape{rays->height, rays->width, 3};
  return py::make_tuple(array_in(&rays->org.front().x, shape, rays),
                        array_in(&rays->dir.front().x, shape, rays));
}

/// The keys of the camera that is fitted to a scene without one.
py::dict fitted_camera(const py::object& source, const py::dict& options) {
  const SceneRequest request(source, {});
  const RenderJob job = picture_job(Arguments(options));
  const auto origin = std::make_shared<Vec3d>();
  const Camera camera = take(interruptible([=](Call& call) -> Result<Camera> {
    auto loaded = request.load(call);
    if (!loaded) return loaded.error();
    *origin = loaded.value().origin;
    Scene& scene = loaded.value().scene;
    const RenderOptions of_picture = options_of(job, scene);
    if (auto done = settle_camera(scene, of_picture.width, of_picture.height, call.parallel_for());
        !done) {
      return done.error();
    }
    return *scene.camera;
  }));
  return FieldValues(*origin).of(camera);
}

}  // namespace

void bind_camera_rays(py::module_& module) {
  module.def("camera_rays", &camera_rays, inside(), py::arg("source"), py::arg("keys"),
             py::arg("options"));
  module.def("fitted_camera", &fitted_camera, inside(), py::arg("source"), py::arg("options"));
}

}  // namespace boule::python
