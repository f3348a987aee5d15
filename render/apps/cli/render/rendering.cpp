#include "render/apps/cli/render/rendering.h"

#include <fmt/format.h>

#include <cstdlib>
#include <limits>
#include <new>
#include <string_view>
#include <utility>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/render/render_checks.h"
#include "render/apps/cli/report/output_check.h"
#include "render/apps/cli/report/picture_stream.h"
#include "render/apps/job/overlay/overlay_labels.h"
#include "render/apps/job/picture/source_date.h"
#include "render/frame/partial_picture.h"
#include "render/frame/scheduler.h"
#include "render/image/finished_picture.h"
#include "render/image/output_file.h"
#include "render/memory/available_memory.h"
#include "render/prepare/default_camera.h"
#include "render/renderer/scene_hash.h"

namespace boule::cli {
namespace {

CropWindow crop_window(const RenderOptions& options) {
  if (!options.crop) return {};
  return {options.width, options.height, options.crop->x0, options.crop->y0};
}

/// The shape of the picture that these options make.
PictureShape shape_of(const RenderOptions& options) {
  const PixelRect rect = rendered_rect(options);
  PictureShape shape{rect.width(), rect.height(), crop_window(options),
                     AovChannels::names(options.aovs)};
  if (options.transparent) shape.channels.emplace_back("A");
  return shape;
}

/// Whether the file is written while the picture is rendered. Channels come first as a whole, what
/// is kept or shown unfinished is in memory as a whole, and so is what goes into a pipe.
bool comes_in_bands(const RenderCommand& command, bool draws) {
  return !command.partial && !command.checkpoint && !command.preview && !command.shard &&
         !command.aovs.any() && !is_stream(command.output) && command.output != standard_output &&
         !draws && !is_page_name(command.output);
}

/// The job's options, and what this program does besides.
RenderOptions run_options(const Scene& scene, const RenderCommand& command, bool draws) {
  RenderOptions options = options_of(command, scene);
  options.in_bands = comes_in_bands(command, draws);
  if (command.preview && !command.order) options.order = PixelOrder::progressive;
  if (command.partial || command.time_limit || command.checkpoint)
    options.cancel = &StopGuard::flag();
  return options;
}

/// The command line's name for a key of the render options, which alone knows whether they agree;
/// other keys are the scene's and stay.
std::string option_of(const std::string& key) {
  constexpr std::pair<std::string_view, const char*> options[] = {{"image.size", "--size"},
                                                                  {"image.spp", "--spp"},
                                                                  {"render.aa", "--aa"},
                                                                  {"aov", "--aov"},
                                                                  {"crop", "--crop"}};
  for (const auto& [of_options, option] : options) {
    if (key == of_options) return option;
  }
  return key;
}

/// Reports an error of preparing. Too many objects, or a size from the scene, are errors of the
/// scene; a size from the command line is wrong usage.
ExitCode refuse_scene(Diagnostic error, const RenderCommand& command) {
  const bool of_scene = error.key == "instance" ||
                        (error.key == "image.size" && !command.size && !command.width) ||
                        (error.key == "image.spp" && !command.spp && !command.min_spp) ||
                        (error.key == "render.aa" && !command.aa);
  if (of_scene) error.file = command.scene;
  const bool of_usage = !of_scene && !error.key.empty();
  if (of_usage) error.key = option_of(error.key);
  if (error.key == "--size" && command.width) error.key = "--width";
  return refuse(std::move(error), command,
                of_scene   ? invalid_input
                : of_usage ? wrong_usage
                           : failed);
}

}  // namespace

ExitCode Rendering::run() {
  if (auto done = check_command(command_); !done)
    return refuse(done.error(), command_, wrong_usage);
  auto date = source_date();
  if (!date) return refuse(date.error(), command_, wrong_usage);
  date_ = std::move(date).value();
  if (auto done = writes() ? check_outputs(command_) : Status(); !done)
    return refuse(done.error(), command_, failed);
  if (auto done = check_module(asks_for_drawing(command_)); !done)
    return refuse(done.error(), command_, failed);
  std::optional<Renderer> renderer;
  const ExitCode prepared = prepare(renderer);
  // The error is reported. The image module may still be loading: to wait for it would take time,
  // and to end the program normally meanwhile could crash.
  if (prepared != done && image_start_ && !image_start_->done()) std::_Exit(prepared);
  if (prepared != done || !renderer) return prepared;
  for (const std::string& text : renderer->notes()) {
    // A camera that nobody could have set need not be told of.
    if (!loader_.is_made() || text != camera_note) report_.note_once("boule: note: " + text);
  }
  if (auto done = complete_overlay(*renderer); !done) return explain(done.error());
  return render(*renderer);
}

Result<LoadedScene> Rendering::load() {
  live_.start_stage("reading " + printable(command_.scene));
  const ReadingLimit::Reading reading(reading_limit_, command_.scene);
  return loader_.load(command_.frame);
}

/// An error if the picture needs the module that draws, and it cannot be loaded. `draws`: something
/// is drawn on it.
Status Rendering::check_module(bool draws) const {
  const std::string& page = command_.output;
  const bool needs = draws || (is_page_name(page) && !page.ends_with(".svg"));
  return writes() && needs ? check_overlay_module() : Status();
}

/// Keeps what is needed of the scene once the renderer has it.
Status Rendering::keep_facts(LoadedScene& loaded) {
  origin_ = loaded.origin;
  const OverlayParts parts = overlay_of(command_, loaded.scene);
  draws_ = !parts.empty() || has_labels(loaded.particles);
  if (draws_ && !can_be_drawn_on(command_)) {
    draws_ = false;
    report_.note_once("boule: note: nothing is drawn on " +
                      std::string(command_.shard ? "a shard" : "colours before tone mapping") +
                      ", though the scene asks for it");
  }
  std::optional<double> frame;
  if (command_.frame && !command_.turn)
    frame = static_cast<double>(*command_.frame) / command_.interpolate;
  overlay_ =
      overlay_facts(draws_ ? parts : OverlayParts(), loaded.particles, loader_.colors(), frame);
  overlay_.pixels_per_point = size_choice(command_).pixels_per_inch() / 72;
  if (draws_) labelled_ = std::move(loaded.particles);
  return check_module(draws_);
}

/// The facts that depend on the camera.
Status Rendering::complete_overlay(Renderer& renderer) {
  const CameraView& view = renderer.scene().camera_view;
  add_camera(renderer.scene().camera, view, renderer.options().width, overlay_);
  auto labels = seen_labels(labelled_, origin_, renderer);
  if (!labels) return labels.error();
  overlay_.labels = std::move(labels).value();
  for (const std::string& text : overlay_notes(overlay_, view))
    report_.note_once("boule: note: " + text);
  return {};
}

ExitCode Rendering::prepare(std::optional<Renderer>& renderer) {
  auto loaded = load();
  if (!loaded) return refuse(loaded.error(), command_, code_of_loading(loaded.error()));
  if (auto done = check_loaded(command_, loader_, loaded.value()); !done)
    return refuse(done.error(), command_, wrong_usage);
  Scene& scene = loaded.value().scene;
  stats_.load_seconds = watch_.seconds();
  report_.loaded(loaded.value(), stats_.load_seconds);
  if (auto done = keep_facts(loaded.value()); !done) return refuse(done.error(), command_, failed);
  live_.start_stage("preparing " + printable(command_.scene));
  choose_background(command_.background, scene);
  scene_hash_ = scene_hash(scene, Scheduler(command_.threads).parallel_for());

  RenderOptions options = run_options(scene, command_, draws_);
  if (auto done = check_transparency(options, command_); !done)
    return refuse(done.error(), command_, wrong_usage);
  // One process decides: the picture may appear meanwhile.
  if (writes() && command_.skip_existing &&
      is_finished_picture(command_.output, shape_of(options))) {
    skipped_ = true;
    if (team_ != nullptr) team_->skip(command_.frame.value_or(0));
    if (tells_of_itself())
      report_.note("boule: " + command_.output + ": is there already, skipped");
    return done;
  }
  if (auto done = command_.skip_existing ? check_output(command_.output) : Status(); !done)
    return refuse(done.error(), command_, failed);
  // The header, which comes first in a file, says which noise was reached.
  options.in_bands = options.in_bands && team_ == nullptr && !is_measured(options);
  if (const ExitCode code = prepare_parts(options); code != done) return code;
  options.progress = [this](const Progress& progress) { live_.update(progress); };
  // The ranks of a team give their blocks to the leader, which tells of them.
  options.live = team_ == nullptr ? &live_.progress() : nullptr;
  // Begun only here, so that a command that is refused above loads no module.
  const bool encodes = writes() && !command_.shard;
  if (const auto file = encodes ? file_to_encode(command_) : std::nullopt) {
    image_start_.emplace(*file, static_cast<int>(Scheduler(options.threads).workers()));
  }
  // Under a limit on addresses the module is loaded first: libraries that find no memory while they
  // are loaded end the process without a message.
  const auto wait = [this] { return image_start_ ? image_start_->wait() : Status(); };
  if (address_room() != std::numeric_limits<std::uint64_t>::max()) {
    if (auto done = wait(); !done) return refuse(done.error(), command_, failed);
  }
  auto created = Renderer::create(std::move(scene), options);
  if (!created) return refuse_scene(created.error(), command_);
  if (auto done = wait(); !done) return refuse(done.error(), command_, failed);
  renderer = std::move(created).value();
  return done;
}

ExitCode Rendering::render(Renderer& renderer) {
  live_.end_stage();
  report_.prepared(renderer.statistics());
  const bool stops = command_.partial || command_.checkpoint || team_ != nullptr;
  const StopGuard guard(stops ? OnSignal::stop : OnSignal::leave);
  live_.start_time_limit(command_.time_limit);
  if (command_.checkpoint || command_.preview || command_.shard || team_ != nullptr)
    return render_parts(renderer);
  const ExitCode end =
      renderer.options().in_bands ? render_bands(renderer) : render_whole(renderer);
  return end == done && StopGuard::caught() != 0 ? interrupted_by(StopGuard::caught()) : end;
}

/// Reports why a picture could not be made. The library knows that it was stopped, but not whether
/// by a signal or by the time limit.
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
  file.metadata = picture_header(renderer, scene_hash_, origin_, partial_);
  for (auto& entry : resolution_header(size_choice(command_)))
    file.metadata.push_back(std::move(entry));
  if (noise_) {
    for (auto& entry : noise_header(*noise_)) file.metadata.push_back(std::move(entry));
  }
  file.threads = static_cast<int>(renderer.statistics().threads);
  return file;
}

/// Writes the final line and the statistics.
ExitCode Rendering::finish(const Renderer& renderer, const Image& image) {
  const RenderStatistics rendering = of_team_.value_or(renderer.statistics());
  static_cast<RunStatistics&>(stats_) = static_cast<const RunStatistics&>(rendering);
  stats_.work_seconds = rendering.render_seconds;
  stats_.rays = rendering.rays.total();
  const int spp = renderer.options().spp;
  stats_.picture = {{image.width, image.height}, spp, rendering.rays, rendering.faults, noise_};
  stats_.picture->noise_target = renderer.options().noise;
  stats_.picture->aa = renderer.options().aa;
  stats_.total_seconds = watch_.seconds();
  live_.end_stage();
  try {
    report_.detail(fmt::format("written in {:.3f} s", stats_.write_seconds));
    tell_end(image);
    for (const std::string& text : fault_notes(rendering.faults)) report_.note(text);
  } catch (const std::bad_alloc&) {  // the picture is written: a missing line is no failure
  }
  return report_.finish(stats_);
}

void Rendering::tell_end(const Image& image) const {
  const std::string cause = StopGuard::caught() != 0
                                ? fmt::format("interrupted ({})", StopGuard::caught_name())
                                : std::string("stopped by the time limit");
  if (partial_) {  // even if quiet: the exit code does not tell that the picture is partial
    const std::string saved =
        checkpoint_ ? "; " + checkpoint_->file() + " holds them, --resume goes on" : "";
    print_note(fmt::format("boule: {}: partial, {:.1f} % of its {}, {}{}", shown_output(command_),
                           partial_->percent(), partial_->what, cause, saved));
    return;
  }
  if (!tells_of_itself()) return;
  const std::string ranks = team_ != nullptr ? fmt::format(", {} ranks", team_->size()) : "";
  report_.note(fmt::format("boule: {}: {} x {} pixels, {}, {:.2f} s, {:.1f} Mray/s ({}, {}{})",
                           shown_output(command_), image.width, image.height,
                           samples_text(*stats_.picture), stats_.work_seconds, mrays_per_s(stats_),
                           stats_.isa, counted(stats_.threads, "thread"), ranks));
  if (StopGuard::caught() != 0) report_.note("boule: " + cause + ", the picture is finished");
}

/// Whether the picture gets a line. In a series only slow frames do: a line for each frame would
/// hide the others.
bool Rendering::tells_of_itself() const {
  constexpr double long_time = 10;  // seconds
  return !live_.is_series() || command_.verbosity == Verbosity::verbose ||
         watch_.seconds() >= long_time;
}

}  // namespace boule::cli
