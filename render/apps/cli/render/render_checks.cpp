#include "render/apps/cli/render/render_checks.h"

#include <filesystem>
#include <string>
#include <system_error>

#include "core/base/text.h"
#include "render/apps/cli/options/part_options.h"
#include "render/apps/cli/report/movie.h"
#include "render/apps/cli/report/output_check.h"
#include "render/apps/cli/report/picture_stream.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/job/overlay/overlay.h"
#include "render/apps/job/picture/legend.h"
#include "render/image/image_format.h"

namespace boule::cli {
namespace {

/// An error if a file beside the picture would replace one of these.
Status check_beside(const std::string& file, const char* what, const char* option,
                    const std::vector<std::string>& files) {
  RunOptions beside;
  beside.output = file;
  auto done = check_data_files(beside, what, files);
  if (!done) done.error().key = option;
  return done;
}

/// An error if a legend is asked for and there is none, or if it would replace a file that is read.
Status check_legend(const RenderCommand& command, const std::vector<ParticleColors>& colors,
                    const std::vector<std::string>& files) {
  if (command.legend.empty()) return {};
  if (!has_legend(colors)) {
    return wrong_option("the scene has no particles whose colours mean numbers or species",
                        "--legend");
  }
  return check_beside(command.legend, "legend", "--legend", files);
}

/// What the preview would be as a picture of its own.
RenderCommand command_of_preview(const RenderCommand& command) {
  RenderCommand shown = command;
  shown.output = command.preview->file;
  shown.format.reset();
  return shown;
}

const char* drawing_option(const RenderCommand& command) {
  return command.overlay && !command.overlay->empty() ? "--overlay" : "--labels";
}

/// An error if the picture cannot have what is drawn on it.
Status check_overlay(const RenderCommand& command, const ImageFormat& format) {
  if (is_page_name(command.output) && command.skip_existing)
    return wrong_option("a page, .pdf or .svg, cannot be read back", "--skip-existing");
  if (!asks_for_drawing(command) || !format.hdr) return {};
  return wrong_option(std::string("a .") + format.extension +
                          " file has colours before tone mapping, which nothing is drawn on; "
                          "expected --output to be a .png, .jpg, .pdf or .svg file, for example",
                      drawing_option(command));
}

/// An error if there can be no picture of this name before the picture is finished.
Status check_preview(const RenderCommand& command) {
  if (!command.preview) return {};
  const std::string& file = command.preview->file;
  if (command.shard) return wrong_option("is of pictures, not of a shard", "--preview");
  const RenderCommand shown = command_of_preview(command);
  const ImageFormat* const format = picture_format(shown);
  if (format == nullptr) {
    return wrong_option("no picture format has the extension of " + quote(file) +
                            ", expected one of " + known_image_extensions(),
                        "--preview");
  }
  auto done = check_overlay(shown, *format);
  if (!done) return wrong_option(done.error().message, "--preview");
  return check_beside(file, "preview", "--preview", {command.scene, command.output});
}

}  // namespace

bool can_be_drawn_on(const RenderCommand& command) {
  return !command.shard && !picture_format(command)->hdr;
}

bool asks_for_drawing(const RenderCommand& command) {
  return (command.overlay && !command.overlay->empty()) || !command.look.labels.empty();
}

Status check_command(const RenderCommand& command) {
  if (auto done = check_part_options(command); !done) return done;
  if (auto done = check_preview(command); !done) return done;
  if (command.shard && asks_for_drawing(command)) {
    return wrong_option(
        "is drawn on finished pictures, not on a shard; boule merge does not know the scene",
        drawing_option(command));
  }
  if (command.shard) return check_run(command, command, "film", {command.scene});
  if (auto done = check_picture_stream(command); !done) return done;
  const ImageFormat* const format = picture_format(command);
  if (format == nullptr) {
    return wrong_option("no picture format has the extension of " + quote(command.output) +
                            ", expected one of " + known_image_extensions() +
                            ", a page: pdf, svg, or a movie: " + joined(movie_endings, ", "),
                        "--output");
  }
  if (auto done = check_overlay(command, *format); !done) return done;
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
  std::vector<std::string> others = {command.scene};
  if (!command.legend.empty()) others.push_back(command.legend);
  return check_run(command, command, "picture", others);
}

Status check_outputs(const RenderCommand& command) {
  if (auto done = check_stats_target(command.stats); !done) return done;
  if (auto done = command.legend.empty() ? Status() : check_output(command.legend); !done)
    return done;
  if (auto done = command.preview ? check_output(command.preview->file) : Status(); !done)
    return done;
  if (command.output == standard_output) return check_standard_output();
  std::error_code ignored;
  const bool may_stay = command.skip_existing && std::filesystem::exists(command.output, ignored);
  return may_stay ? Status() : check_output(command.output);
}

Status check_loaded(const RenderCommand& command, const SceneLoader& loader,
                    const LoadedScene& loaded) {
  if (auto done = check_legend(command, loader.colors(), loaded.data_files); !done) return done;
  if (command.preview) {
    auto done = check_beside(command.preview->file, "preview", "--preview", loaded.data_files);
    if (!done) return done;
  }
  return check_data_files(command, "picture", loaded.data_files);
}

Status check_transparency(const RenderOptions& options, const RenderCommand& command) {
  if (command.shard) return {};  // merge knows the picture's format
  if (command.preview && options.transparent &&
      !picture_format(command_of_preview(command))->alpha) {
    return wrong_option("cannot be transparent, expected an .exr or .png file", "--preview");
  }
  const ImageFormat& format = *picture_format(command);
  if (!options.transparent || format.alpha) return {};
  return wrong_option(std::string("a .") + format.extension +
                          " file cannot be transparent, expected --output to be an .exr or .png "
                          "file, or --background to be a colour",
                      command.background ? "--background" : "image.transparent");
}

}  // namespace boule::cli
