#include "render/python/rendering.h"

#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/math/srgb.h"
#include "render/cli/option_values.h"
#include "render/frame/partial_picture.h"
#include "render/frame/scheduler.h"
#include "render/python/arguments.h"
#include "render/python/call.h"
#include "render/python/picture.h"
#include "render/python/presence.h"
#include "render/python/scenes.h"
#include "render/renderer/scene_hash.h"

namespace py = pybind11;

namespace boule::python {
namespace {

using Clock = std::chrono::steady_clock;

/// What the arguments of a render say; what is not given comes from the scene.
struct Wishes {
  std::optional<std::array<int, 2>> size;
  std::optional<int> spp, min_spp, max_depth, tile, threads;
  std::optional<PixelFilter> filter;
  std::optional<Method> method;
  std::optional<Solver> solver;
  std::optional<PixelOrder> order;
  std::optional<double> noise, exposure, outline, shadow_epsilon, time_limit;
  std::optional<std::uint64_t> seed;
  std::optional<std::array<int, 4>> crop;
  std::optional<cli::BackgroundChoice> background;
  std::optional<std::string> isa;
  AovSelection aovs;
  bool partial = false;
};

/// A length, or "none": 0.
std::optional<double> shadow_epsilon_of(const Arguments& given) {
  const auto object = given.find("shadow_epsilon");
  if (object && py::isinstance<py::str>(*object)) {
    if (given.text("shadow_epsilon") != "none")
      throw_error("shadow_epsilon",
                  "expected a number or 'none', got " + quote(std::string(py::str(*object))));
    return 0;
  }
  constexpr double most = std::numeric_limits<float>::max();
  return given.number("shadow_epsilon", {.low = 0, .high = most});
}

AovSelection aovs_of(const Arguments& given) {
  const auto object = given.find("aov");
  if (!object) return {};
  std::string names;
  if (py::isinstance<py::str>(*object)) {
    names = *given.text("aov");
  } else {
    if (!py::isinstance<py::sequence>(*object)) throw_error("aov", "expected names");
    for (const py::handle name : *object) {
      names += (names.empty() ? "" : ",") + std::string(py::str(name));
    }
    if (names.empty()) return {};
  }
  const auto aovs = cli::parse_aovs(names);
  if (!aovs) {
    throw_error("aov", quote(names) + " is not understood, expected some of " + cli::list_aovs() +
                           ", each once");
  }
  return *aovs;
}

std::optional<cli::BackgroundChoice> background_of(const Arguments& given) {
  const auto text = given.text("background");
  if (!text) return std::nullopt;
  const auto choice = cli::parse_background(*text);
  if (!choice) {
    throw_error(
        "background",
        quote(*text) + " is not understood, expected a colour such as #ffffff, or transparent");
  }
  return choice;
}

Wishes wishes_of(const py::dict& dictionary) {
  const Arguments given(dictionary);
  Wishes wishes;
  wishes.size = given.wholes<2>("size", rule::image_side);
  wishes.spp = given.whole("spp", rule::samples);
  wishes.noise = given.number("noise", rule::noise);
  wishes.min_spp = given.whole("min_spp", rule::least_samples);
  wishes.exposure = given.number("exposure", {.low = -100, .high = 100});
  wishes.filter = given.choice<PixelFilter>("filter");
  wishes.background = background_of(given);
  wishes.outline = given.number("outline", rule::outline);
  wishes.seed = given.any_whole("seed");
  wishes.crop = given.wholes<4>("crop", {.low = 0, .high = max_image_side});
  wishes.aovs = aovs_of(given);
  wishes.method = given.choice<Method>("method");
  wishes.max_depth = given.whole("max_depth", rule::bounces);
  wishes.shadow_epsilon = shadow_epsilon_of(given);
  wishes.time_limit =
      given.number("time_limit", {.low = 0, .high = 1e9, .takes_low = false, .unit = " seconds"});
  wishes.partial = given.flag("partial");
  if (const auto order = given.text("order")) {
    wishes.order = choose<PixelOrder>(*order, "order", order_names);
  }
  wishes.tile = given.whole("tile", {.low = 1, .high = max_tile});
  wishes.isa = isa_of(given);
  wishes.solver = given.choice<Solver>("solver");
  wishes.threads = given.whole("threads", thread_counts);
  return wishes;
}

RenderOptions combine(const Scene& scene, const Wishes& wishes) {
  RenderOptions options = options_of(scene);
  if (wishes.size)
    std::tie(options.width, options.height) = std::tuple((*wishes.size)[0], (*wishes.size)[1]);
  std::optional<float> noise;
  if (wishes.noise) noise = static_cast<float>(*wishes.noise);
  choose_samples(wishes.spp, noise, options);
  options.min_spp = wishes.min_spp.value_or(options.min_spp);
  options.exposure_stops = static_cast<float>(wishes.exposure.value_or(0));
  options.filter = wishes.filter.value_or(options.filter);
  options.method = wishes.method.value_or(options.method);
  options.max_depth = wishes.max_depth.value_or(options.max_depth);
  if (wishes.shadow_epsilon) options.shadow_epsilon = static_cast<float>(*wishes.shadow_epsilon);
  if (wishes.outline) options.outline = static_cast<float>(*wishes.outline);
  if (wishes.crop) {
    const auto [x0, y0, x1, y1] = *wishes.crop;
    options.crop = PixelRect{x0, y0, x1, y1};
  }
  options.aovs = wishes.aovs;
  options.seed = wishes.seed.value_or(0);
  options.tile = wishes.tile.value_or(0);
  options.order =
      wishes.order.value_or(wishes.partial ? PixelOrder::progressive : PixelOrder::tiles);
  options.threads = static_cast<unsigned>(wishes.threads.value_or(0));
  options.isa = wishes.isa.value_or("auto");
  options.solver = wishes.solver.value_or(Solver::robust);
  return options;
}

/// One render, which its thread and the waiting one share.
class Run {
 public:
  Run(SceneRequest request, Wishes wishes)
      : request_(std::move(request)), wishes_(std::move(wishes)) {}

  /// The picture; unfinished, or none, if it was stopped.
  Status work(Call& call);

  /// After work(): the picture, if there is one.
  [[nodiscard]] const std::shared_ptr<const PictureParts>& picture() const { return picture_; }

  [[nodiscard]] bool is_out_of_time() const {
    if (!wishes_.time_limit || !is_rendering_) return false;
    return std::chrono::duration<double>(Clock::now() - begin_.load()).count() >=
           *wishes_.time_limit;
  }
  /// Of all samples; none before the rendering begins.
  [[nodiscard]] std::optional<double> share() const {
    if (!is_rendering_) return std::nullopt;
    return live_.read().share;
  }

 private:
  Status render(Renderer& renderer, PictureParts& parts, const Call& call);
  Status render_measured(Renderer& renderer, PictureParts& parts, const Outline& lines,
                         const Call& call) const;
  void describe(const Renderer& renderer, PictureParts& parts) const;

  SceneRequest request_;
  Wishes wishes_;
  LiveProgress live_;
  std::atomic<Clock::time_point> begin_{};
  std::atomic<bool> is_rendering_{false};
  std::shared_ptr<const PictureParts> picture_;
};

Status Run::work(Call& call) {
  auto loaded = request_.load(call);
  if (!loaded) return loaded.error();
  Scene& scene = loaded.value().scene;
  cli::choose_background(wishes_.background, scene);
  RenderOptions options = combine(scene, wishes_);
  options.cancel = &call.cancel;
  options.live = &live_;
  auto parts = std::make_shared<PictureParts>();
  parts->notes = std::move(loaded.value().notes);
  parts->origin = loaded.value().origin;
  if (auto done = validate(scene); !done) return done;
  parts->scene_hash = scene_hash(scene, Scheduler(options.threads).parallel_for());
  auto renderer = Renderer::create(std::move(scene), options);
  if (!renderer) return renderer.error();
  begin_ = Clock::now();
  is_rendering_ = true;
  if (auto done = render(renderer.value(), *parts, call); !done) return done;
  describe(renderer.value(), *parts);
  picture_ = std::move(parts);
  return {};
}

/// Renders the extra channels and the lines first: a picture that is stopped has them too.
Status Run::render(Renderer& renderer, PictureParts& parts, const Call& call) {
  if (wishes_.aovs.any_traced()) {
    auto aovs = renderer.render_aovs();
    if (!aovs) return aovs.error();
    parts.channels = std::move(aovs).value();
  }
  auto lines = renderer.render_outline();
  if (!lines) return lines.error();
  if (renderer.options().noise > 0) return render_measured(renderer, parts, lines.value(), call);
  Film film(renderer.rect());
  Status status = renderer.render_live(film);
  const Alpha alpha = alpha_of(renderer.options());
  if (!status) {
    const std::uint64_t all =
        renderer.rect().area() * static_cast<std::uint64_t>(renderer.options().spp);
    if (!call.cancel || film.total_samples() == 0) return status;
    parts.partial = cli::PartialSamples{film.total_samples(), all};
    parts.image = partial_picture(film, renderer.options().order, alpha);
  } else {
    parts.image = film.to_image(alpha);
  }
  if (renderer.options().outline > 0) lines.value().draw(parts.image);
  return {};
}

Status Run::render_measured(Renderer& renderer, PictureParts& parts, const Outline& lines,
                            const Call& call) const {
  const RenderOptions& options = renderer.options();
  MeasuredPicture measured(renderer.rect());
  Film film(renderer.rect());
  Status status = renderer.render_measured(measured, wishes_.partial ? &film : nullptr);
  if (!status && (!call.cancel || film.total_samples() == 0)) return status;
  if (!status)
    parts.partial = cli::PartialSamples{count_measured(measured), renderer.rect().area(), "pixels"};
  parts.noise = noise_reached(measured, options.spp);
  parts.image = status ? measured.image(alpha_of(options))
                       : partial_picture(film, measured, options.order, alpha_of(options));
  if (options.outline > 0) lines.draw(parts.image);
  for (ImageChannel& channel : measured_channels(options.aovs, measured))
    parts.channels.push_back(std::move(channel));
  return {};
}

void Run::describe(const Renderer& renderer, PictureParts& parts) const {
  const RenderOptions& options = renderer.options();
  parts.header = cli::picture_header(renderer, parts.scene_hash, parts.origin, parts.partial);
  if (parts.noise) {
    for (auto& entry : cli::noise_header(*parts.noise)) parts.header.push_back(std::move(entry));
  }
  if (options.crop) {
    parts.crop = {options.width, options.height, options.crop->x0, options.crop->y0};
  }
  parts.statistics = renderer.statistics();
  parts.spp = options.spp;
  parts.notes.insert(parts.notes.end(), renderer.notes().begin(), renderer.notes().end());
}

/// A render that Python waits for. What its progress tells is called by Python, between two waits:
/// no code of the caller runs inside a call of ours.
class Rendering {
 public:
  Rendering(const py::object& source, const py::dict& keys, const py::dict& given)
      : run_(std::make_shared<Run>(SceneRequest(source, keys), wishes_of(given))),
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

}  // namespace

void bind_rendering(py::module_& module) {
  py::class_<Rendering>(module, "Rendering")
      .def(py::init<const py::object&, const py::dict&, const py::dict&>(), inside(),
           py::arg("source"), py::arg("keys"), py::arg("options"))
      .def("wait", &Rendering::wait, inside(), py::arg("ticks"))
      .def("share", &Rendering::share, inside())
      .def("stop", &Rendering::stop, inside())
      .def("end", &Rendering::end, inside());
}

}  // namespace boule::python
