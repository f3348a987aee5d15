#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/report/output_check.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/job/picture/picture_header.h"
#include "render/apps/job/picture/source_date.h"
#include "render/apps/parts/film_file.h"
#include "render/apps/parts/part_blocks.h"
#include "render/frame/scheduler.h"
#include "render/image/image_format.h"

namespace boule::cli {
namespace {

/// The films of one picture, as they are read.
class Merging {
 public:
  explicit Merging(const MergeCommand& command) : command_(command) {}

  /// Reads all films. The Diagnostic names the one that is wrong, or what is missing.
  Status read() {
    for (const std::string& file : command_.films) {
      if (auto done = add(file); !done) return done;
    }
    return check_blocks();
  }

  [[nodiscard]] const FilmHead& head() const { return head_; }
  PartSheet& sheet() { return *sheet_; }
  /// None: the picture is finished.
  [[nodiscard]] const std::optional<PartialSamples>& partial() const { return partial_; }
  [[nodiscard]] Image image() const;

 private:
  Status add(const std::string& file);
  Status check_blocks();

  const MergeCommand& command_;
  FilmHead head_;  ///< of the first film, with the blocks of all
  std::optional<PartSheet> sheet_;
  std::optional<PartialSamples> partial_;
};

Status Merging::add(const std::string& file) {
  const auto reader = film_file::Reader::open(file);
  if (!reader) return reader.error();
  const FilmHead& head = reader.value().head();
  if (!sheet_) {
    head_ = head;
    head_.blocks.clear();
    sheet_.emplace(head.rect, head.kinds);
  } else {
    const std::string difference = find_difference(head.facts, head_.facts);
    if (!difference.empty())
      return Diagnostic::in_file(file, difference + ", as " + command_.films.front());
    if (!(head.rect == head_.rect) || head.kinds.pixel_bytes() != head_.kinds.pixel_bytes())
      return Diagnostic::in_file(file, "is not of the pixels of " + command_.films.front());
  }
  if (auto done = reader.value().read(*sheet_); !done) return done;
  head_.blocks.insert(head_.blocks.end(), head.blocks.begin(), head.blocks.end());
  return {};
}

Status Merging::check_blocks() {
  const std::string gap = find_gap(head_.rect, head_.blocks);
  if (!gap.empty()) return Diagnostic::of("the films do not make a picture: " + gap);
  const PartialSamples samples = samples_of(*sheet_, head_.blocks, head_.spp);
  if (samples.done == 0) return Diagnostic::of("the films do not make a picture: no pixel is done");
  if (samples.done < samples.all) partial_ = samples;
  return {};
}

/// Where noise is measured, a film has nothing of pixels that are not.
Image Merging::image() const {
  const Alpha alpha = head_.transparent ? Alpha::coverage : Alpha::none;
  if (!partial_) return sheet_->image(alpha);
  return sheet_->partial_image(head_.order, alpha,
                               Film(head_.kinds.measured ? head_.rect : PixelRect{}));
}

/// An error if the picture cannot be written in that format.
Status check_format(const FilmHead& head, const MergeCommand& command) {
  const ImageFormat& format = *find_image_format(command.output);
  if (head.kinds.aovs.any() && !format.channels) {
    return wrong_option("the films have extra channels, expected --output to be an .exr file",
                        "--output");
  }
  if (head.transparent && !format.alpha) {
    return wrong_option("the films are transparent, expected --output to be an .exr or .png file",
                        "--output");
  }
  return {};
}

ImageFileOptions file_options(const MergeCommand& command, Merging& merging,
                              const std::string& date) {
  const FilmHead& head = merging.head();
  ImageFileOptions file;
  file.compression = command.compression;
  file.exposure_stops = command.exposure_stops;
  const PixelRect frame{0, 0, head.frame_width, head.frame_height};
  if (!(head.rect == frame))
    file.crop = {head.frame_width, head.frame_height, head.rect.x0, head.rect.y0};
  file.date_time = date;
  file.metadata = head.metadata;
  if (merging.partial()) file.metadata.push_back(merging.partial()->remark());
  if (head.kinds.measured) {
    for (auto& entry : noise_header(noise_reached(merging.sheet().measured(), head.spp)))
      file.metadata.push_back(std::move(entry));
  }
  file.channels = merging.sheet().release_channels();
  file.threads = static_cast<int>(Scheduler(command.threads).workers());
  file.stop = [] { return WriteGuard::interrupted(); };
  return file;
}

ExitCode write(const MergeCommand& command, Merging& merging, const std::string& date) {
  const Image image = merging.image();
  const Status status = write_guarded(
      [&] { return write_image(image, command.output, file_options(command, merging, date)); },
      "the picture had been written");
  if (!status) return report(status.error(), failed);
  const std::string films = counted(command.films.size(), "film");
  if (const auto& partial = merging.partial()) {  // even if quiet, as render does
    print_note(fmt::format("boule: {}: partial, {:.1f} % of its {}, of {}", command.output,
                           partial->percent(), partial->what, films));
  } else if (!command.quiet) {
    print_note(fmt::format("boule: {}: {} x {} pixels, {} spp, of {}", command.output, image.width,
                           image.height, merging.head().spp, films));
  }
  return done;
}

}  // namespace

ExitCode run(const MergeCommand& command) {
  if (find_image_format(command.output) == nullptr) {
    return report(wrong_option("no picture format has the extension of " + quote(command.output) +
                                   ", expected one of " + known_image_extensions(),
                               "--output"),
                  wrong_usage);
  }
  const auto date = source_date();
  if (!date) return report(date.error(), wrong_usage);
  if (auto done = film_file::check_support(); !done) return report(done.error(), failed);
  RunOptions outputs;
  outputs.output = command.output;
  if (auto done = check_data_files(outputs, "picture", command.films); !done)
    return report(done.error(), wrong_usage);
  if (auto done = check_output(command.output); !done) return report(done.error(), failed);
  Merging merging(command);
  if (auto done = merging.read(); !done) return report(done.error(), invalid_input);
  if (auto done = check_format(merging.head(), command); !done)
    return report(done.error(), wrong_usage);
  return write(command, merging, date.value());
}

}  // namespace boule::cli
