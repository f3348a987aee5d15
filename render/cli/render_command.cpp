#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "render/cli/commands.h"
#include "render/cli/frames.h"
#include "render/cli/interrupt.h"
#include "render/cli/live_report.h"
#include "render/cli/messages.h"
#include "render/cli/output_check.h"
#include "render/cli/picture_header.h"
#include "render/cli/reading_limit.h"
#include "render/cli/run_report.h"
#include "render/cli/series_totals.h"
#include "render/cli/source_date.h"
#include "render/frame/partial_picture.h"
#include "render/frame/scheduler.h"
#include "render/frame/stopwatch.h"
#include "render/image/finished_picture.h"
#include "render/image/image_format.h"
#include "render/image/image_start.h"
#include "render/image/output_file.h"
#include "render/memory/available_memory.h"
#include "render/renderer/renderer.h"
#include "render/renderer/scene_hash.h"
#include "render/scene_file/scene_file.h"

namespace boule::cli {
namespace {

/// What can be told wrong without reading the scene.
Status check(const RenderCommand& command) {
  const ImageFormat* const format = find_image_format(command.output);
  if (format == nullptr) {
    return wrong_option("no picture format has the extension of " + quote(command.output) +
                            ", expected one of " + known_image_extensions(),
                        "--output");
  }
  if (command.aovs.any() && !format->channels) {
    return wrong_option(
        std::string("a .") + format->extension +
            " file has no room for extra channels, expected --output to be an .exr file",
        "--aov");
  }
  if (command.skip_existing && command.partial && !format->remarks) {
    return wrong_option(std::string("a .") + format->extension +
                            " file cannot say that it is partial: it would be skipped",
                        "--skip-existing");
  }
  if (command.skip_existing && command.crop && !format->channels) {
    return wrong_option(std::string("a .") + format->extension +
                            " file cannot say which crop it is: another one would be skipped",
                        "--skip-existing");
  }
  return check_run(command, "picture", {command.scene});
}

/// What can be told wrong with the files to be written. A picture that is there may be left alone:
/// then it need not be writable.
Status check_outputs(const RenderCommand& command) {
  if (auto bad = check_stats_target(command.stats)) return bad;
  std::error_code ignored;
  const bool may_stay = command.skip_existing && std::filesystem::exists(command.output, ignored);
  return may_stay ? std::nullopt : check_output(command.output);
}

RenderOptions combine(const Scene& scene, const RenderCommand& command) {
  RenderOptions options = options_of(scene);
  if (command.size) {
    options.width = command.size->width;
    options.height = command.size->height;
  }
  options.spp = command.spp.value_or(options.spp);
  options.filter = command.filter.value_or(options.filter);
  options.method = command.method.value_or(options.method);
  options.max_depth = command.max_depth.value_or(options.max_depth);
  options.crop = command.crop;
  options.aovs = command.aovs;
  options.seed = command.seed;
  options.tile = command.tile;
  options.order =
      command.order.value_or(command.partial ? PixelOrder::progressive : PixelOrder::tiles);
  if (command.partial || command.time_limit) options.cancel = &StopGuard::flag();
  options.threads = command.threads;
  options.isa = command.isa;
  options.solver = command.solver;
  return options;
}

CropWindow crop_window(const RenderOptions& options) {
  if (!options.crop) return {};
  return {options.width, options.height, options.crop->x0, options.crop->y0};
}

/// report(), the frame named where there is one.
ExitCode refuse(Diagnostic error, const RenderCommand& command, ExitCode code) {
  if (command.frame) error.message = fmt::format("frame {}: {}", *command.frame, error.message);
  return report(error, code);
}

/// A size that the scene asks for, or too many objects, are the scene's fault, a size from the
/// command line the caller's.
ExitCode refuse_scene(Diagnostic error, const RenderCommand& command) {
  const bool of_scene = error.key == "instance" || (error.key == "image.size" && !command.size);
  if (of_scene) error.file = command.scene;
  const bool of_usage = !of_scene && !error.key.empty();
  return refuse(std::move(error), command,
                of_scene   ? invalid_input
                : of_usage ? wrong_usage
                           : failed);
}

/// One run of `boule render`, step by step; each step that fails leaves its exit code.
class Rendering {
 public:
  /// `live` must outlive it.
  Rendering(RenderCommand command, LiveReport& live)
      : command_(std::move(command)),
        live_(live),
        report_(command_, live),
        reading_limit_(command_.load_limit) {}

  ExitCode run();

  /// Afterwards: whether the picture was there already, else what it took.
  [[nodiscard]] bool skipped() const { return skipped_; }
  [[nodiscard]] const Stats& stats() const { return stats_; }

 private:
  /// Loads the scene and hands it over to be prepared: nothing stays of what was loaded, it may be
  /// as large as all the rest. No renderer and done: the picture is there already.
  ExitCode prepare(std::optional<Renderer>& renderer);
  Result<LoadedScene> load();
  ExitCode render(Renderer& renderer);
  Result<Image> make_image(Renderer& renderer);
  ExitCode explain(const Diagnostic& error) const;
  ExitCode write(const Image& image, ImageFileOptions options);
  ExitCode finish(const Renderer& renderer, const Image& image);
  void tell_end(const Renderer& renderer, const Image& image) const;
  [[nodiscard]] bool tells_of_itself() const;
  [[nodiscard]] ImageFileOptions file_options(const Renderer& renderer) const;

  const RenderCommand command_;  ///< before what refers to it
  LiveReport& live_;
  RunReport report_;
  ReadingLimit reading_limit_;
  bool skipped_ = false;
  Stopwatch watch_;
  Stats stats_;
  std::string date_;  ///< that the file is stamped with
  std::uint64_t scene_hash_ = 0;
  std::optional<PartialSamples> partial_;  ///< none: the picture is finished
  std::optional<ImageStart> image_start_;  ///< beside preparing
};

ExitCode Rendering::run() {
  if (auto bad = check(command_)) return refuse(*bad, command_, wrong_usage);
  auto date = source_date();
  if (!date) return refuse(date.error(), command_, wrong_usage);
  date_ = std::move(date).value();
  if (auto bad = check_outputs(command_)) return refuse(*bad, command_, failed);
  std::optional<Renderer> renderer;
  const ExitCode prepared = prepare(renderer);
  // All is said. Waiting for what is not needed any more would be a pity, and the end of the
  // program while it is loaded a danger.
  if (prepared != done && image_start_ && !image_start_->done()) std::_Exit(prepared);
  if (prepared != done || !renderer) return prepared;
  for (const std::string& text : renderer->notes()) report_.note_once("boule: note: " + text);
  return render(*renderer);
}

Result<LoadedScene> Rendering::load() {
  live_.start_stage("reading " + printable(command_.scene));
  const ReadingLimit::Reading reading(reading_limit_, command_.scene);
  return load_scene(command_.scene, {command_.polygons, command_.frame});
}

ExitCode Rendering::prepare(std::optional<Renderer>& renderer) {
  auto loaded = load();
  if (!loaded) return refuse(loaded.error(), command_, invalid_input);
  if (auto bad = check_data_files(command_, "picture", loaded.value().data_files))
    return refuse(*bad, command_, wrong_usage);
  Scene& scene = loaded.value().scene;
  stats_.load_seconds = watch_.seconds();
  report_.loaded(loaded.value(), stats_.load_seconds);
  live_.start_stage("preparing " + printable(command_.scene));
  scene_hash_ = scene_hash(scene);

  RenderOptions options = combine(scene, command_);
  const PixelRect rect = rendered_rect(options);
  const PictureShape shape{rect.width(), rect.height(), crop_window(options),
                           AovChannels::names(options.aovs)};
  if (command_.skip_existing && is_finished_picture(command_.output, shape)) {
    skipped_ = true;
    if (tells_of_itself())
      report_.note("boule: " + command_.output + ": is there already, skipped");
    return done;
  }
  if (auto bad = command_.skip_existing ? check_output(command_.output) : std::nullopt)
    return refuse(*bad, command_, failed);
  options.progress = [this](const Progress& progress) { live_.update(progress); };
  options.live = &live_.progress();
  // Not before: what is refused loads nothing until here.
  image_start_.emplace(command_.output, static_cast<int>(Scheduler(options.threads).workers()));
  // Libraries that load while others take what a limit leaves end the process without a word.
  if (address_room() != std::numeric_limits<std::uint64_t>::max()) {
    if (auto bad = image_start_->wait()) return refuse(*bad, command_, failed);
  }
  auto created = Renderer::create(std::move(scene), options);
  if (!created) return refuse_scene(created.error(), command_);
  if (auto bad = image_start_->wait()) return refuse(*bad, command_, failed);
  renderer = std::move(created).value();
  return done;
}

ExitCode Rendering::render(Renderer& renderer) {
  live_.end_stage();
  report_.prepared(renderer.statistics());
  const StopGuard guard(command_.partial ? OnSignal::stop : OnSignal::leave);
  live_.start_time_limit(command_.time_limit);
  std::vector<ImageChannel> channels;
  if (command_.aovs.any()) {  // first: a picture that is stopped has them too
    live_.start_stage("finding the extra channels of " + printable(command_.output));
    auto aovs = renderer.render_aovs();
    if (!aovs) return explain(aovs.error());
    channels = std::move(aovs).value();
  }
  live_.start_pass("pixels");
  const auto image = make_image(renderer);
  live_.end_pass();
  live_.end_time_limit();
  if (!image) return explain(image.error());
  ImageFileOptions options = file_options(renderer);
  options.channels = std::move(channels);
  live_.start_stage("writing " + printable(command_.output));
  const ExitCode written = write(image.value(), options);
  const ExitCode end = written == done ? finish(renderer, image.value()) : written;
  return end == done && StopGuard::caught() != 0 ? interrupted_by(StopGuard::caught()) : end;
}

/// The finished picture, or what there is when it is stopped and that was asked for.
Result<Image> Rendering::make_image(Renderer& renderer) {
  if (!command_.partial) return renderer.render();
  Film film(renderer.rect());
  const Status status = renderer.render_live(film);
  if (!status) return film.to_image();
  const PartialSamples samples{
      film.total_samples(),
      renderer.rect().area() * static_cast<std::uint64_t>(renderer.options().spp)};
  if (!StopGuard::flag() || samples.done == 0) return *status;
  partial_ = samples;
  return partial_picture(film, renderer.options().order);
}

/// The line and exit code of a picture that could not be made: where it was stopped the library
/// knows only that, not why.
ExitCode Rendering::explain(const Diagnostic& error) const {
  if (StopGuard::caught() != 0) leave_as_caught();
  if (!StopGuard::flag()) return refuse(error, command_, failed);
  const std::string limit = fmt::format("the time limit of {} s came ", *command_.time_limit);
  const char* const end = command_.partial
                              ? "before the first sample, nothing written"
                              : "first, nothing written; --partial writes what there is";
  return refuse(Diagnostic::of(limit + end), command_, failed);
}

ImageFileOptions Rendering::file_options(const Renderer& renderer) const {
  const RenderOptions& options = renderer.options();
  ImageFileOptions file;
  file.compression = command_.compression;
  file.exposure_stops = command_.exposure_stops;
  file.crop = crop_window(options);
  file.date_time = date_;
  file.metadata = picture_header(renderer, scene_hash_, partial_);
  file.threads = static_cast<int>(renderer.statistics().threads);
  return file;
}

ExitCode Rendering::write(const Image& image, ImageFileOptions options) {
  const Stopwatch watch;
  Status status;
  // Rendering is over: a signal that would have stopped it stops the waiting for a pipe's reader.
  const auto caught = [before = StopGuard::caught()] { return StopGuard::caught() != before; };
  {
    const WriteGuard guard;
    std::optional<RemovalGuard> removal;
    options.stop = [&caught, stream = is_stream(command_.output)] {
      return WriteGuard::interrupted() || (stream && caught());
    };
    options.temporary = [&](const std::string& path) {
      removal.reset();
      path.empty() ? tell_sending(command_.output) : static_cast<void>(removal.emplace(path));
    };
    status = write_image(image, command_.output, options);
    removal.reset();
    if (!status) {
      set_written(live_.is_series() ? "the frames up to this one had been written"
                                    : "the picture had been written");
    }
  }
  exit_if_interrupted();
  if (status && caught()) leave_as_caught();
  stats_.write_seconds = watch.seconds();
  return status ? refuse(*status, command_, failed) : done;
}

/// After the picture: the line that says so, and the statistics.
ExitCode Rendering::finish(const Renderer& renderer, const Image& image) {
  const RenderStatistics rendering = renderer.statistics();
  static_cast<RunStatistics&>(stats_) = static_cast<const RunStatistics&>(rendering);
  stats_.work_seconds = rendering.render_seconds;
  stats_.rays = rendering.rays.total();
  const int spp = renderer.options().spp;
  stats_.picture = {{image.width, image.height}, spp, rendering.rays, rendering.faults};
  stats_.total_seconds = watch_.seconds();
  live_.end_stage();
  try {
    report_.detail(fmt::format("written in {:.3f} s", stats_.write_seconds));
    tell_end(renderer, image);
    for (const std::string& text : fault_notes(rendering.faults)) report_.note(text);
  } catch (const std::bad_alloc&) {  // the picture is there: a line less is no failure
  }
  return report_.finish(stats_);
}

void Rendering::tell_end(const Renderer& renderer, const Image& image) const {
  const std::string cause = StopGuard::caught() != 0
                                ? fmt::format("interrupted ({})", StopGuard::caught_name())
                                : std::string("stopped by the time limit");
  if (partial_) {  // in any case: the exit code of a time limit does not tell it
    print_note(fmt::format("boule: {}: partial, {:.1f} % of its samples, {}", command_.output,
                           partial_->percent(), cause));
    return;
  }
  if (!tells_of_itself()) return;
  report_.note(fmt::format("boule: {}: {} x {} pixels, {} spp, {:.2f} s, {:.1f} Mray/s ({}, {})",
                           command_.output, image.width, image.height, renderer.options().spp,
                           stats_.work_seconds, mrays_per_s(stats_), stats_.isa,
                           counted(stats_.threads, "thread")));
  if (StopGuard::caught() != 0) report_.note("boule: " + cause + ", the picture is finished");
}

/// Of many frames only those that take their time, a line each would drown the rest.
bool Rendering::tells_of_itself() const {
  constexpr double long_time = 10;  // seconds
  return !live_.is_series() || command_.verbosity == Verbosity::verbose ||
         watch_.seconds() >= long_time;
}

ExitCode run_series(const RenderCommand& command, const FrameRange& frames) {
  if (auto bad = check_frames(command)) return report(*bad, wrong_usage);
  if (auto bad = check_folders(command, frames)) return report(*bad, failed);
  LiveReport live(command, frames.count());
  SeriesTotals totals;
  for (int number = frames.first; number <= frames.last; number += frames.step) {
    live.start_frame();
    Rendering frame(command_of_frame(command, number), live);
    const ExitCode code = frame.run();
    if (code != done) return code;
    if (frame.skipped()) {
      live.skip_frame();
      totals.add_skipped();
    } else {
      totals.add(frame.stats());
    }
    set_written("earlier frames had been written, this one not");
  }
  live.end_series();
  if (live.is_series() && command.verbosity != Verbosity::quiet)
    print_note("boule: " + printable(command.output) + ": " + totals.text(live.seconds()));
  return done;
}

}  // namespace

ExitCode run(const RenderCommand& command) {
  if (command.frames) return run_series(command, *command.frames);
  if (auto bad = check_single(command)) return report(*bad, wrong_usage);
  LiveReport live(command);
  return Rendering(command, live).run();
}

}  // namespace boule::cli
