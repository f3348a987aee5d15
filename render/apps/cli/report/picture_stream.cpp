#include "render/apps/cli/report/picture_stream.h"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <functional>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/report/movie.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/job/overlay/overlay.h"
#include "render/image/encode_image.h"
#include "render/image/output_file.h"

namespace boule::cli {
namespace {

const std::string stream_name = "standard output";

/// How much is written at once: a pipe that poll() calls ready takes so much without blocking.
std::size_t piece_size() {
  constexpr std::size_t of_files = 1 << 20;
  struct stat info {};
  const bool is_file = fstat(STDOUT_FILENO, &info) == 0 && S_ISREG(info.st_mode);
  return is_file ? of_files : PIPE_BUF;
}

/// Writes all bytes. Returns 0 or an errno code: ECANCELED if `stop` returned true.
int send(const std::string& bytes, const std::function<bool()>& stop) {
  constexpr int patience_ms = 100;
  const std::size_t most = piece_size();
  for (std::size_t done = 0; done < bytes.size();) {
    if (stop && stop()) return ECANCELED;
    pollfd ready{STDOUT_FILENO, POLLOUT, 0};
    if (poll(&ready, 1, patience_ms) == 0) continue;
    const std::size_t count = std::min(most, bytes.size() - done);
    const ssize_t written = ::write(STDOUT_FILENO, bytes.data() + done, count);
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (written < 0) return errno;
    done += static_cast<std::size_t>(written);
  }
  return 0;
}

}  // namespace

std::string shown_output(const RenderCommand& command) {
  if (!command.movie.empty()) return command.movie;
  return command.output == standard_output ? stream_name : command.output;
}

Status check_picture_stream(const RenderCommand& command) {
  if (command.output != standard_output) {
    if (!command.format) return {};
    return wrong_option("is for pictures on standard output, expected '-o -'; the extension of " +
                            quote(command.output) + " names the format of that file",
                        "--format");
  }
  if (!command.format) {
    return wrong_option("is missing: a picture on standard output needs one of ppm, png, rgb",
                        "--format");
  }
  if (command.stats.form == StatsForm::json && command.stats.file == "-") {
    return wrong_option("standard output has the picture, expected json:FILE or text", "--stats");
  }
  if (command.skip_existing) {
    return wrong_option("standard output keeps no pictures that could be skipped",
                        "--skip-existing");
  }
  return {};
}

const ImageFormat* picture_format(const RenderCommand& command) {
  if (is_page_name(command.output)) return find_image_format("picture.png");
  if (command.output != standard_output) return find_image_format(command.output);
  return find_image_format(command.format == StreamFormat::png ? "picture.png" : "picture.ppm");
}

std::optional<std::string> file_to_encode(const RenderCommand& command) {
  if (is_page_name(command.output)) return "picture.png";
  if (command.output != standard_output) return command.output;
  return command.format == StreamFormat::png ? std::optional(stream_name + ".png") : std::nullopt;
}

Status send_picture(const Image& image, StreamFormat format, const std::string& movie,
                    const ImageFileOptions& options) {
  auto bytes = encode_image(image, format, stream_name, options);
  if (!bytes) return bytes.error();
  if (options.temporary) options.temporary({});
  const int code = send(bytes.value(), options.stop);
  if (code == 0) return {};
  if (code == EPIPE && !movie.empty()) return cannot_write(movie, movie_complaint());
  if (code == EPIPE) leave_unread();
  return code == ECANCELED ? cannot_write(stream_name, "interrupted")
                           : cannot_write(stream_name, code);
}

}  // namespace boule::cli
