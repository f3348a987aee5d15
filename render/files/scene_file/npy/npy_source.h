#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/file/input_file.h"
#include "render/files/packed/sphere_source.h"
#include "render/files/packed/spill_file.h"
#include "render/files/scene_file/loaded/scene_origin.h"

namespace boule {

/// The spheres of .npy files, one file after the other: N x 4 numbers each, centre and radius. They
/// are read part by part, so that there may be any number of them. First extent(), if at all.
class NpySource final : public SphereSource {
 public:
  /// Opens the files; "-", alone, is standard input. What comes from there goes into a temporary
  /// file beside `beside`, to be read twice. Errors name the file, those of read() also the row.
  static Result<std::unique_ptr<NpySource>> open(const std::vector<std::string>& paths,
                                                 const std::string& beside,
                                                 const ParallelFor& parallel_for);

  /// Where all spheres are, before they are rounded. Reads all.
  Result<SphereExtent> extent();
  /// The point that is subtracted from centres before they are rounded.
  void set_origin(const Vec3d& origin) { origin_ = origin; }

  Status seek(std::uint64_t sphere) override;
  Status read(std::vector<Sphere>& part, std::size_t most) override;
  void forget(std::uint64_t before) override;

 private:
  struct File {
    std::string name;
    InputFile file;
    std::uint64_t begin, rows;  ///< of its data in bytes; how many rows
    std::size_t width;          ///< bytes of a number
    bool is_pipe;

    [[nodiscard]] std::size_t row_bytes() const { return 4 * width; }
  };

  /// Some rows of a file.
  struct Rows {
    File* file = nullptr;
    std::uint64_t first = 0;
    std::size_t count = 0;
  };

  explicit NpySource(const ParallelFor& parallel_for) : parallel_for_(parallel_for) {}
  Status add(const std::string& path);
  static Status named(const File& file, Status status);
  /// Reads the next rows into `rows_`; none at the end.
  Status next_rows(std::size_t most, Rows& rows);
  Status read_rows(File& file, std::uint64_t first, std::size_t count);
  Status read_pipe(File& file, std::uint64_t first);
  Status read_pipe_on(File& file, std::size_t begin);

  const ParallelFor& parallel_for_;
  std::vector<File> files_;
  Vec3d origin_;
  std::uint64_t next_ = 0;
  std::vector<unsigned char> rows_;
  std::optional<SpillFile> spool_;  ///< all rows of a pipe that were read
  std::uint64_t forgotten_ = 0;     ///< bytes of it
};

}  // namespace boule
