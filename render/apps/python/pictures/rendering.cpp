#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "render/apps/job/options/look_choices.h"
#include "render/apps/job/options/render_choices.h"
#include "render/apps/job/overlay/legend_room.h"
#include "render/apps/job/overlay/overlay_labels.h"
#include "render/apps/job/picture/legend.h"
#include "render/apps/job/picture/rendered_picture.h"
#include "render/apps/python/pictures/picture.h"
#include "render/apps/python/scenes/scenes.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/job_arguments.h"
#include "render/apps/python/values/presence.h"
#include "render/frame/scheduler.h"
#include "render/renderer/scene_hash.h"

namespace py = pybind11;

namespace boule::python {
namespace {

using Clock = std::chrono::steady_clock;

/// What the arguments of a render say.
RenderJob job_of(const py::dict& dictionary) {
  const Arguments given(dictionary);
  RenderJob job;
  SceneJob& scene = job;
  read_rows(given, scene_choices(), scene);
  read_rows(given, render_choices(), job);
  isa_of(given);
  job.time_limit =
      given.number("time_limit", {.low = 0, .high = 1e9, .takes_low = false, .unit = " seconds"});
  job.partial = given.flag("partial");
  return job;
}

/// The frame that is asked for, if it is counted from the first.
std::optional<int> frame_of(const py::dict& keys) {
  if (!keys.contains("frame") || !py::isinstance<py::int_>(keys["frame"])) return std::nullopt;
  const auto frame = py::cast<long long>(keys["frame"]);
  return frame >= 0 ? std::optional(static_cast<int>(frame)) : std::nullopt;
}

/// One render, which its thread and the waiting one share.
class Run {
 public:
  Run(SceneRequest request, RenderJob job, std::optional<int> frame)
      : request_(std::move(request)), job_(std::move(job)), frame_(frame) {}

  /// The picture; unfinished, or none, if it was stopped.
  Status work(Call& call);

  /// After work(): the picture, if there is one.
  [[nodiscard]] const std::shared_ptr<const PictureParts>& picture() const { return picture_; }

  [[nodiscard]] bool is_out_of_time() const {
    if (!job_.time_limit || !is_rendering_) return false;
    return std::chrono::duration<double>(Clock::now() - begin_.load()).count() >= *job_.time_limit;
  }
  /// Of all samples; none before the rendering begins.
  [[nodiscard]] std::optional<double> share() const {
    if (!is_rendering_) return std::nullopt;
    return live_.read().share;
  }

 private:
  Status render(Renderer& renderer, PictureParts& parts, const Call& call);
  void describe(const Renderer& renderer, PictureParts& parts) const;

  SceneRequest request_;
  RenderJob job_;
  std::optional<int> frame_;  ///< that is asked for
  LiveProgress live_;
  std::atomic<Clock::time_point> begin_{};
  std::atomic<bool> is_rendering_{false};
  std::shared_ptr<const PictureParts> picture_;
};

Status Run::work(Call& call) {
  auto loaded = request_.load(call);
  if (!loaded) return loaded.error();
  Scene& scene = loaded.value().scene;
  leave_legend_room(job_.overlay, size_choice(job_), loaded.value());
  const auto particles = std::move(loaded.value().particles);
  const OverlayParts overlay = overlay_of(job_, scene);
  const bool draws = !overlay.empty() || has_labels(particles);
  if (auto done = draws ? check_overlay_module() : Status(); !done) return done;
  choose_background(job_.background, scene);
  RenderOptions options = options_of(job_, scene);
  options.cancel = &call.cancel;
  options.live = &live_;
  auto parts = std::make_shared<PictureParts>();
  parts->overlay = overlay_facts(overlay, particles, colors_of(particles), frame_);
  parts->notes = std::move(loaded.value().notes);
  parts->origin = loaded.value().origin;
  if (auto done = validate(scene); !done) return done;
  parts->scene_hash = scene_hash(scene, Scheduler(options.threads).parallel_for());
  auto renderer = Renderer::create(std::move(scene), options);
  if (!renderer) return renderer.error();
  begin_ = Clock::now();
  is_rendering_ = true;
  auto labels = seen_labels(particles, parts->origin, renderer.value());
  if (!labels) return labels.error();
  parts->overlay.labels = std::move(labels).value();
  if (auto done = render(renderer.value(), *parts, call); !done) return done;
  describe(renderer.value(), *parts);
  picture_ = std::move(parts);
  return {};
}

/// Renders the extra channels and the lines first: a picture that is stopped has them too.
Status Run::render(Renderer& renderer, PictureParts& parts, const Call& call) {
  if (job_.aovs.any_traced()) {
    auto aovs = renderer.render_aovs();
    if (!aovs) return aovs.error();
    parts.channels = std::move(aovs).value();
  }
  auto made = render_picture(renderer, job_.partial, [&] { return call.cancel.load(); });
  if (!made) return made.error();
  RenderedPicture& picture = made.value();
  parts.image = std::move(picture.image);
  parts.partial = picture.partial;
  parts.noise = picture.noise;
  std::move(picture.channels.begin(), picture.channels.end(), std::back_inserter(parts.channels));
  return {};
}

void Run::describe(const Renderer& renderer, PictureParts& parts) const {
  const RenderOptions& options = renderer.options();
  parts.header = picture_header(renderer, parts.scene_hash, parts.origin, parts.partial);
  for (auto& entry : resolution_header(size_choice(job_))) parts.header.push_back(std::move(entry));
  if (parts.noise) {
    for (auto& entry : noise_header(*parts.noise)) parts.header.push_back(std::move(entry));
  }
  if (options.crop) {
    parts.crop = {options.width, options.height, options.crop->x0, options.crop->y0};
  }
  const CameraView& view = renderer.scene().camera_view;
  add_camera(renderer.scene().camera, view, options.width, parts.overlay);
  parts.overlay.pixels_per_point = size_choice(job_).pixels_per_inch() / 72;
  parts.statistics = renderer.statistics();
  parts.spp = options.spp;
  parts.notes.insert(parts.notes.end(), renderer.notes().begin(), renderer.notes().end());
  for (std::string& text : overlay_notes(parts.overlay, view))
    parts.notes.push_back(std::move(text));
}

/// A render that Python waits for. What its progress tells is called by Python, between two waits:
/// no code of the caller runs inside a call of ours.
class Rendering {
 public:
  Rendering(const py::object& source, const py::dict& keys, const py::dict& given)
      : run_(std::make_shared<Run>(SceneRequest(source, keys), job_of(given), frame_of(keys))),
        waiting_(call_, work(), options(given)) {}

  /// Waits until it has ended; true if it has. With `ticks` it waits a tenth of a second at most.
  bool wait(bool ticks) {
    constexpr std::chrono::milliseconds tick_every{100};
    return ticks ? waiting_.wait(Clock::now() + tick_every) : waiting_.wait();
  }
  [[nodiscard]] std::optional<double> share() const { return run_->share(); }
  /// Ends it; the picture, or None.
  py::object stop() {
    waiting_.stop();
    return waiting_.end() == CallEnd::left ? py::none() : picture();
  }
  /// Once it has ended: a picture or None, and what stopped it: an exception, "time" or None.
  [[nodiscard]] py::tuple end() const;

 private:
  [[nodiscard]] std::function<void()> work() const {
    return [run = run_, call = call_, status = status_] { *status = run->work(*call); };
  }
  [[nodiscard]] WaitOptions options(const py::dict& given) const {
    return {.is_out_of_time = [run = run_] { return run->is_out_of_time(); },
            .waits_for_end = Arguments(given).flag("partial")};
  }
  [[nodiscard]] py::object picture() const {
    return run_->picture() ? py::cast(Picture{run_->picture()}) : py::none();
  }

  std::shared_ptr<Run> run_;
  std::shared_ptr<Call> call_ = std::make_shared<Call>();
  std::shared_ptr<Status> status_ = std::make_shared<Status>();
  Waiting waiting_;
};

py::tuple Rendering::end() const {
  const CallEnd end = waiting_.end();
  const auto& raised = waiting_.raised();
  const py::object stopped = raised ? py::object(raised->value()) : py::none();
  if (end == CallEnd::left) return py::make_tuple(py::none(), stopped);
  if (end == CallEnd::done && !*status_) throw_error(status_->error());
  if (end == CallEnd::stopped_by_time && !raised) return py::make_tuple(picture(), "time");
  return py::make_tuple(picture(), stopped);
}

/// Adds the options of a list with the value that each has where it is not given.
template <class List>
void add_defaults(py::dict& defaults, const List& list) {
  const auto add = [&]<class Row>(const Row& row) {
    const bool is_flag = std::is_same_v<decltype(row.rule), FlagRule>;
    defaults[py::str(std::string(row.name))] = is_flag ? py::object(py::bool_(false)) : py::none();
  };
  std::apply([&](const auto&... row) { (add(row), ...); }, list);
}

/// The options that say how a file of particles is read.
py::list names_of_file_choices() {
  py::list names;
  const auto add = [&](const auto& row) {
    if (row.group == heading::particle_file) names.append(std::string(row.name));
  };
  std::apply([&](const auto&... row) { (add(row), ...); }, look_choices());
  return names;
}

}  // namespace

void bind_rendering(py::module_& module) {
  py::dict of_pictures, of_looks;
  add_defaults(of_pictures, render_choices());
  add_defaults(of_pictures, scene_choices());
  add_defaults(of_looks, look_choices());
  module.attr("render_choices") = of_pictures;
  module.attr("look_choices") = of_looks;
  module.attr("file_choices") = names_of_file_choices();
  py::class_<Rendering>(module, "Rendering")
      .def(py::init<const py::object&, const py::dict&, const py::dict&>(), inside(),
           py::arg("source"), py::arg("keys"), py::arg("options"))
      .def("wait", &Rendering::wait, inside(), py::arg("ticks"))
      .def("share", &Rendering::share, inside())
      .def("stop", &Rendering::stop, inside())
      .def("end", &Rendering::end, inside());
}

}  // namespace boule::python
