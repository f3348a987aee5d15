#pragma once

#include <sys/types.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "render/image/output_file.h"

namespace boule::cli {

/// What the names of movies end in.
inline constexpr std::array<std::string_view, 3> movie_endings{".mp4", ".webm", ".gif"};

/// Whether the name is that of a movie.
bool is_movie_name(const std::string& name);

/// A movie that the program ffmpeg makes of the pictures on standard output. It appears under its
/// name when it is complete. One at a time.
class Movie {
 public:
  /// Starts ffmpeg, found by PATH, and leads standard output to it: from now on PPM pictures of one
  /// size are written there. `fps`: pictures a second. Precondition: is_movie_name(name).
  static Result<Movie> start(const std::string& name, double fps);

  Movie(Movie&& other) noexcept;
  Movie(const Movie&) = delete;
  Movie& operator=(Movie&&) = delete;
  Movie& operator=(const Movie&) = delete;
  /// Without finish() no movie appears.
  ~Movie();

  /// After the last picture: waits for ffmpeg and gives the movie its name.
  Status finish();

 private:
  Movie(OutputFile file, std::string name, pid_t ffmpeg)
      : file_(std::move(file)), name_(std::move(name)), ffmpeg_(ffmpeg) {}
  int wait();

  OutputFile file_;
  std::string name_;
  pid_t ffmpeg_;  ///< 0: none
};

/// What ffmpeg says of the movie that it makes: the last line of its errors, or that it ended.
std::string movie_complaint();

}  // namespace boule::cli
