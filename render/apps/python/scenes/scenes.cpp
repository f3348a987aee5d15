#include "render/apps/python/scenes/scenes.h"

#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "core/scene/instances.h"
#include "render/apps/job/options/render_choices.h"
#include "render/apps/job/particle_scene.h"
#include "render/apps/job/scene_loader.h"
#include "render/apps/python/scenes/scene_values.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/job_arguments.h"
#include "render/apps/python/values/made_by_calls.h"
#include "render/apps/python/values/presence.h"
#include "render/files/packed/pack.h"
#include "render/files/packed/packed_file.h"
#include "render/files/scene_file/loaded/frame_name.h"
#include "render/files/scene_file/scene_tree.h"
#include "render/memory/available_memory.h"

namespace py = pybind11;

namespace boule::python {
namespace {

constexpr WholeRule any_frame{.low = std::numeric_limits<int>::min(),
                              .high = std::numeric_limits<int>::max()};

/// What `boule render` would be told of a file. "frame" may be that of a series.
RenderJob job_of(const std::string& path, const py::dict& keys) {
  RenderJob job;
  job.scene = path;
  const py::dict of_look = keys.attr("copy")();
  of_look.attr("pop")("frame", py::none());
  job.look = look_of(of_look);
  SceneJob& scene = job;
  read_rows(Arguments(keys), scene_choices(), scene);
  return job;
}

/// A loader of the frames of a series, which tell each note once. One thread at a time uses it; the
/// others wait.
struct Series {
  std::mutex mutex;
  std::set<std::string> told;
  RenderJob job;
  SceneData data;
  std::unique_ptr<SceneLoader> loader;
};

/// The name of what has no file.
constexpr const char* in_memory = "particles in memory";

/// Errors about particles in memory name no file.
Diagnostic without_memory(Diagnostic error) {
  if (error.file == in_memory) error.file.clear();
  return error;
}

std::shared_ptr<ParticleFile> particles_in(const Data& data) {
  const auto* const file = std::get_if<std::shared_ptr<ParticleFile>>(&data.held);
  if (file == nullptr) throw_error("particles", "expected particles");
  return *file;
}

std::shared_ptr<Series> open_series(const std::string& path, int first, int last, int step,
                                    int interpolate, const py::dict& keys) {
  auto series = std::make_shared<Series>();
  series->job = job_of(path, keys);
  series->job.frames = FrameRange{first, last, step};
  series->job.interpolate = interpolate;
  series->loader = std::make_unique<SceneLoader>(series->job);
  return series;
}

/// A series of particles in memory, one frame each.
std::shared_ptr<Series> series_of(const std::vector<Data>& all, const py::dict& keys) {
  auto series = std::make_shared<Series>();
  std::vector<ParticleFrame> frames;
  for (const Data& one : all) frames.push_back(take(particles_in(one)->read(0)));
  series->data.particles.emplace(
      in_memory, std::make_shared<ParticleFile>(ParticleFile::of(std::move(frames))));
  series->job.scene = in_memory;
  series->job.look = look_of(keys);
  series->job.frames = FrameRange{0, static_cast<int>(all.size()) - 1, 1};
  series->loader =
      std::make_unique<SceneLoader>(series->job, nullptr, SceneLoader::most_spheres, &series->data);
  return series;
}

py::dict next_of_series(const std::shared_ptr<Series>& series, int frame) {
  return values_of(take(interruptible([series, frame](Call&) {
    const std::lock_guard lock(series->mutex);
    auto loaded = series->loader->load(frame);
    if (!loaded) return Result<LoadedScene>(without_memory(loaded.error()));
    std::erase_if(loaded.value().notes,
                  [&](const std::string& note) { return !series->told.insert(note).second; });
    return loaded;
  })));
}

/// How many frames a file of particles has.
std::size_t count_frames(const std::string& path, const py::dict& keys) {
  const RenderJob job = job_of(path, keys);
  return take(interruptible([job](Call& call) -> Result<std::size_t> {
    if (!is_particle_input(job.scene, job.look)) {
      return Diagnostic::in_file(job.scene,
                                 "no file of particles by its name or content: say which frames");
    }
    auto file = ParticleFile::open(job.scene, file_options_of(job.look), call.parallel_for());
    if (!file) return file.error();
    return file.value().frames();
  }));
}

py::dict read_scene(const py::object& source, const py::dict& keys) {
  const SceneRequest request(source, keys);
  return values_of(take(interruptible([request](Call& call) { return request.load(call); })));
}

/// The scene that shows particles in memory.
py::dict show_particles(const Data& data, const py::dict& keys) {
  const LookOptions look = look_of(keys);
  auto made = take(interruptible([look, file = particles_in(data)](Call& call) {
    SceneData all;
    all.particles.emplace(in_memory, file);
    SceneFileOptions options;
    options.data = &all;
    options.parallel_for = call.parallel_for();
    auto scene = load_particle_scene(in_memory, look, options);
    return scene ? std::move(scene) : Result<ParticleScene>(without_memory(scene.error()));
  }));
  return values_of(std::move(made.loaded));
}

/// Writes a scene to a packed file.
void pack_scene(const py::object& source, const std::string& path) {
  if (!is_packed_name(path)) throw_error("path", "expected a name that ends with .boule");
  const SceneRequest request(source, {});
  check(interruptible([request, path](Call& call) -> Status {
    auto loaded = request.load(call);
    if (!loaded) return loaded.error();
    Scene& scene = loaded.value().scene;
    expand_instances(scene);
    SpheresInMemory spheres(std::exchange(scene.spheres, {}));
    const PackMeans means{.memory = available_memory() / 2,
                          .beside = {},
                          .parallel_for = call.parallel_for(),
                          .stop = [&call] { return call.cancel.load(); }};
    const auto packed = pack({std::move(scene), loaded.value().origin, spheres, path, means});
    return packed ? Status() : packed.error();
  }));
}

}  // namespace

SceneRequest::SceneRequest(const py::object& source, const py::dict& keys) {
  if (!py::isinstance<py::dict>(source)) {
    RenderJob job = job_of(py::cast<std::string>(source), keys);
    const std::optional<int> frame = Arguments(keys).whole("frame", any_frame);
    const bool of_file = !has_frame_slot(job.scene) && is_particle_input(job.scene, job.look);
    (of_file ? job.look.frame : frame_) = frame;
    source_ = std::move(job);
    return;
  }
  for (const auto& [key, value] : keys) {
    if (value.is_none() || value.is(py::bool_(false))) continue;
    if (py::cast<std::string>(py::str(key)) == "frame") continue;
    throw_error(py::str(key), "is of files, and the scene is none");
  }
  frame_ = Arguments(keys).whole("frame", any_frame);
  Tree tree;
  TreeBuilder builder;
  tree.members = builder.members(py::reinterpret_borrow<py::dict>(source), "");
  tree.data = builder.data();
  source_ = std::move(tree);
}

Result<LoadedScene> SceneRequest::load(Call& call) const {
  if (const auto* job = std::get_if<RenderJob>(&source_)) {
    return SceneLoader(*job).load(frame_);
  }
  const Tree& tree = std::get<Tree>(source_);
  SceneFileOptions options;
  options.data = &tree.data;
  options.frame = frame_;
  options.parallel_for = call.parallel_for();
  return load_scene_tree(tree.members, tree.folder, options);
}

void bind_scenes(py::module_& module) {
  const py::class_<Data> data(module, "Data", made_by_calls(),
                              "Something large that a scene holds: spheres, a picture, ...");
  py::class_<Series, std::shared_ptr<Series>>(module, "Series")
      .def(py::init(&open_series), inside(), py::arg("path"), py::arg("first"), py::arg("last"),
           py::arg("step"), py::arg("interpolate"), py::arg("keys"))
      .def("read", &next_of_series, inside(), py::arg("frame"));
  module.def("series_of", &series_of, inside(), py::arg("all"), py::arg("keys"));
  module.def("count_frames", &count_frames, inside(), py::arg("path"), py::arg("keys"));
  module.def("pack", &pack_scene, inside(), py::arg("source"), py::arg("path"));
  module.def("read", &read_scene, inside(), py::arg("source"), py::arg("keys"));
  module.def("show_particles", &show_particles, inside(), py::arg("particles"), py::arg("keys"));
}

}  // namespace boule::python
