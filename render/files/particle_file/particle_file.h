#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_reader.h"

namespace boule {

/// The names of all formats ("xyz", "dump", ...), and the list of their endings for messages.
std::vector<std::string_view> particle_formats();
std::string known_particle_endings();

/// True if a file of this name is one of particles by its ending. (.npy files are not: scene_file
/// reads those, unless they hold named fields.)
bool is_particle_name(std::string_view path);

/// True if the content of the file tells a format; false, too, if it cannot be read.
bool has_particle_content(const std::string& path);

/// A particle file: one frame or a trajectory. Opening it finds the frames (a trajectory is read
/// through once for that), so that each frame is then read by itself. Takes any file; throws
/// std::bad_alloc.
class ParticleFile {
 public:
  static Result<ParticleFile> open(const std::string& path, const ParticleFileOptions& options = {},
                                   const ParallelFor& parallel_for = serial_for);

  /// Frames in memory, one or more, as if they were a file; reading one copies it.
  static ParticleFile of(ParticleFrame frame);
  static ParticleFile of(std::vector<ParticleFrame> frames);

  [[nodiscard]] std::size_t frames() const { return reader_->frames(); }

  /// "the file is cut off in frame 2 (line 13: it ...)"; empty if it is not.
  [[nodiscard]] std::string cut_text() const;

  /// A frame, from 0; negative numbers count from the end, -1 is the last. An error if there is no
  /// such frame. Where the file was cut off behind its whole frames, a note says so.
  Result<ParticleFrame> read(long frame = -1, const ParallelFor& parallel_for = serial_for);

  /// A frame part by part, which this object outlives; null if it is read as a whole only: by its
  /// format, or because a topology has a part in it. Precondition: frame < frames().
  Result<std::unique_ptr<FrameParts>> parts(std::size_t frame);

  /// The name of the format that was found.
  [[nodiscard]] std::string_view format() const { return format_; }

 private:
  ParticleFile(std::string path, std::string_view format, std::unique_ptr<ParticleReader> reader);

  std::string path_;
  std::string_view format_;
  std::unique_ptr<ParticleReader> reader_;
  std::optional<ParticleFrame> topology_;
  Status packing_whole_;  ///< an error if the packed bytes end too early
};

}  // namespace boule
