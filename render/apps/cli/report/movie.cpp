#include "render/apps/cli/report/movie.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>
#include <vector>

#include "core/base/text.h"

namespace boule::cli {
namespace {

/// Where ffmpeg writes its errors to; -1: nowhere.
int complaints = -1;

/// The descriptor under which ffmpeg has the movie.
constexpr int movie_descriptor = 3;

/// How a format is made.
struct MovieFormat {
  std::string_view ending;
  std::vector<const char*> options;
};

/// Colours are those of the pictures: sRGB, which BT.709 stands for in movies. Its sides are even.
const std::vector<MovieFormat>& movie_formats() {
  constexpr const char* colors =
      "scale=trunc(iw/2)*2:trunc(ih/2)*2:out_color_matrix=bt709:out_range=tv,format=yuv420p";
  static const std::vector<MovieFormat> formats{
      {movie_endings[0],
       {"-vf", colors, "-c:v", "libx264", "-crf", "18", "-colorspace", "bt709", "-color_primaries",
        "bt709", "-color_trc", "bt709", "-movflags", "+faststart", "-f", "mp4"}},
      {movie_endings[1],
       {"-vf", colors, "-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "24", "-colorspace", "bt709",
        "-color_primaries", "bt709", "-color_trc", "bt709", "-f", "webm"}},
      {movie_endings[2], {"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-f", "gif"}}};
  return formats;
}

const MovieFormat* format_of(const std::string& name) {
  for (const MovieFormat& format : movie_formats()) {
    if (ascii_lower(name).ends_with(format.ending)) return &format;
  }
  return nullptr;
}

std::string text_of_file(int descriptor) {
  std::string text(1 << 14, '\0');
  const ssize_t count = descriptor < 0 ? 0 : pread(descriptor, text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

/// What ffmpeg is told, besides its own name.
std::vector<std::string> arguments_for(const MovieFormat& format, double fps) {
  std::vector<std::string> all = {"ffmpeg",
                                  "-nostdin",
                                  "-v",
                                  "error",
                                  "-y",
                                  "-f",
                                  "image2pipe",
                                  "-c:v",
                                  "ppm",
                                  "-framerate",
                                  fmt::format("{}", fps),
                                  "-i",
                                  "pipe:0",
                                  "-map_metadata",
                                  "-1",
                                  "-fflags",
                                  "+bitexact",
                                  "-flags:v",
                                  "+bitexact"};
  all.insert(all.end(), format.options.begin(), format.options.end());
  all.push_back(fmt::format("/proc/self/fd/{}", movie_descriptor));
  return all;
}

/// Starts it; an errno code in place of its number where that fails.
Result<pid_t> spawn(const std::vector<std::string>& arguments, int pictures, int movie) {
  std::vector<char*> words;
  for (const std::string& one : arguments) words.push_back(const_cast<char*>(one.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pictures, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, complaints, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, complaints, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, movie, movie_descriptor);
  pid_t process = 0;
  const int code = posix_spawnp(&process, "ffmpeg", &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (code == 0) return process;
  if (code == ENOENT) {
    return Diagnostic::about("--output",
                             "a movie needs the program ffmpeg, which is not in PATH: install "
                             "ffmpeg (Debian: apt install ffmpeg)");
  }
  return cannot_write("ffmpeg", code);
}

}  // namespace

bool is_movie_name(const std::string& name) { return format_of(name) != nullptr; }

Result<Movie> Movie::start(const std::string& name, double fps) {
  auto file = OutputFile::create(name);
  if (!file) return file.error();
  complaints = memfd_create("ffmpeg", MFD_CLOEXEC);
  std::array<int, 2> pipe{};
  if (complaints < 0 || pipe2(pipe.data(), O_CLOEXEC) != 0) return cannot_write(name, errno);
  // Above those that ffmpeg gets: none of them is overwritten before it is passed on.
  constexpr int above = 10;
  const int pictures = fcntl(pipe[0], F_DUPFD_CLOEXEC, above);
  const int movie = fcntl(file.value().descriptor(), F_DUPFD_CLOEXEC, above);
  const int old_complaints = std::exchange(complaints, fcntl(complaints, F_DUPFD_CLOEXEC, above));
  ::close(old_complaints);
  auto ffmpeg = spawn(arguments_for(*format_of(name), fps), pictures, movie);
  for (const int descriptor : {pictures, movie, pipe[0]}) ::close(descriptor);
  if (ffmpeg) dup2(pipe[1], STDOUT_FILENO);
  ::close(pipe[1]);
  if (!ffmpeg) return ffmpeg.error();
  return Movie(std::move(file).value(), name, ffmpeg.value());
}

Movie::Movie(Movie&& other) noexcept
    : file_(std::move(other.file_)),
      name_(std::move(other.name_)),
      ffmpeg_(std::exchange(other.ffmpeg_, 0)) {}

Movie::~Movie() {
  if (ffmpeg_ != 0) wait();
}

/// Ends the pictures and waits. Returns whether ffmpeg was content: 0.
int Movie::wait() {
  const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing >= 0) dup2(nothing, STDOUT_FILENO);
  if (nothing >= 0) ::close(nothing);
  int status = 0;
  const pid_t process = std::exchange(ffmpeg_, 0);
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

Status Movie::finish() {
  if (wait() != 0) return cannot_write(name_, movie_complaint());
  return file_.commit();
}

std::string movie_complaint() {
  const std::string text = text_of_file(complaints);
  const auto lines = words_of(text, "\n");
  return "ffmpeg: " + (lines.empty() ? "it ended" : std::string(without_blanks(lines.back())));
}

}  // namespace boule::cli
