#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/render/rendering.h"
#include "render/apps/cli/report/picture_stream.h"
#include "render/apps/job/picture/rendered_picture.h"
#include "render/frame/scheduler.h"
#include "render/frame/stopwatch.h"
#include "render/image/band_writer.h"

/// The picture itself: as a whole, or in bands that are written while the next ones are rendered.
namespace boule::cli {
namespace {

ImageForm form_of(const RenderOptions& options) {
  const PixelRect rect = rendered_rect(options);
  return {rect.width(), rect.height(), alpha_of(options)};
}

}  // namespace

ExitCode Rendering::render_whole(Renderer& renderer) {
  std::vector<ImageChannel> channels;
  if (command_.aovs.any_traced()) {  // first: a picture that is stopped has them too
    live_.start_stage("finding the extra channels of " + printable(shown_output(command_)));
    auto aovs = renderer.render_aovs();
    if (!aovs) return explain(aovs.error());
    channels = std::move(aovs).value();
  }
  live_.start_pass("pixels");
  const auto image = make_image(renderer, channels);
  live_.end_pass();
  live_.end_time_limit();
  if (!image) return explain(image.error());
  ImageFileOptions options = file_options(renderer);
  options.channels = std::move(channels);
  live_.start_stage("writing " + printable(shown_output(command_)));
  const ExitCode written = write(image.value(), options);
  return written == done ? finish(renderer, image.value()) : written;
}

/// The finished picture; or, with --partial, the unfinished one where it was stopped.
Result<Image> Rendering::make_image(Renderer& renderer, std::vector<ImageChannel>& channels) {
  if (!command_.partial && !is_measured(renderer.options())) return renderer.render();
  auto made = render_picture(renderer, command_.partial, [] { return StopGuard::flag().load(); });
  if (!made) return made.error();
  RenderedPicture& picture = made.value();
  partial_ = picture.partial;
  noise_ = picture.noise;
  std::move(picture.channels.begin(), picture.channels.end(), std::back_inserter(channels));
  return std::move(picture.image);
}

template <class Write>
Status Rendering::guarded_write(ImageFileOptions options, const Write& write) {
  // After rendering, a signal that StopGuard catches ends the waiting for a pipe's reader.
  const auto caught = [before = StopGuard::caught()] { return StopGuard::caught() != before; };
  return write_guarded([&] {
    std::optional<RemovalGuard> removal;
    options.stop = [&caught, stream = is_stream(command_.output)] {
      return WriteGuard::interrupted() || (stream && caught());
    };
    options.temporary = [&](const std::string& path) {
      removal.reset();
      path.empty() ? tell_sending(command_.output) : static_cast<void>(removal.emplace(path));
    };
    return write(options);
  });
}

void Rendering::tell_written() const {
  set_written(live_.is_series() ? "the frames up to this one had been written"
                                : "the picture had been written");
}

/// The picture with its overlay.
Status Rendering::write_shown(const Image& image, const std::string& output,
                              ImageFileOptions file) const {
  if (is_page_name(output)) return write_page(image, overlay_, output, file);
  if (!overlay_.is_empty()) {
    auto layer = overlay_layer(overlay_, image, file.exposure_stops);
    if (!layer) return layer.error();
    file.layer = std::move(layer).value();
  }
  return output == standard_output ? send_picture(image, *command_.format, command_.movie, file)
                                   : write_image(image, output, file);
}

ExitCode Rendering::write(const Image& image, ImageFileOptions options) {
  const Stopwatch watch;
  const int caught = StopGuard::caught();
  const Status status = guarded_write(std::move(options), [&](const ImageFileOptions& file) {
    auto written = write_shown(image, command_.output, file);
    if (written) tell_written();
    return written;
  });
  if (!status && StopGuard::caught() != caught) leave_as_caught();
  stats_.write_seconds = watch.seconds();
  return status ? done : refuse(status.error(), command_, failed);
}

void Rendering::show(const Renderer& renderer, const PartRun& run, const FilmHead& head) {
  if (run.sheet().done() == 0 && run.preview().total_samples() == 0) return;
  const PartialSamples samples = samples_of(run.sheet(), head.blocks, head.spp);
  const auto before = std::exchange(partial_, samples);
  if (samples.done == samples.all) partial_.reset();
  const Image image = image_of(run, head);
  ImageFileOptions options = file_options(renderer);
  partial_ = before;
  const Status shown = guarded_write(std::move(options), [&](const ImageFileOptions& file) {
    return write_shown(image, command_.preview->file, file);
  });
  if (!shown) report_.note_once("boule: note: no preview: " + format_diagnostic(shown.error()));
}

/// Rendering and writing at the same time.
ExitCode Rendering::render_bands(Renderer& renderer) {
  const Stopwatch watch;
  bool cancelled = false;
  ImageFileOptions options = file_options(renderer);
  options.threads = static_cast<int>(Scheduler(renderer.options().threads).workers());
  const Status status = guarded_write(std::move(options), [&](const ImageFileOptions& file) {
    auto writer = BandWriter::open(form_of(renderer.options()), command_.output, file);
    if (!writer) return Status(writer.error());
    live_.start_pass("pixels");
    Status done =
        renderer.render_bands([&](const Image& band) { return writer.value().put(band); });
    live_.end_pass();
    live_.end_time_limit();
    cancelled = !done && StopGuard::flag();
    if (!done) return done;
    live_.start_stage("writing " + printable(shown_output(command_)));
    done = writer.value().finish();
    if (done) tell_written();
    return done;
  });
  if (cancelled) return explain(status.error());
  stats_.write_seconds = std::max(watch.seconds() - renderer.statistics().render_seconds, 0.0);
  if (!status) return refuse(status.error(), command_, failed);
  Image size;
  size.width = renderer.rect().width();
  size.height = renderer.rect().height();
  return finish(renderer, size);
}

}  // namespace boule::cli
