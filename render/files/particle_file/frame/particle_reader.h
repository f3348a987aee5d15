#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// How a particle file is read.
struct ParticleFileOptions {
  /// A name of particle_formats(); empty: by the file's name, else its content.
  std::string format{};
  /// Names for the columns, for files that do not name them themselves; empty: those of the format.
  std::vector<std::string> columns{};
  bool water = false;  ///< PDB and mmCIF: with water
  /// The columns to keep besides positions and species; none: all.
  std::optional<std::vector<std::string>> wanted{};
  /// The bonds that a file lists are read for frames of at most so many particles; 0: for none.
  std::uint64_t most_bonded = 0;
  /// A column whose numbers must be above 0: the first that is not is an error with its place, in
  /// formats of text rows (xyz, dump, data, table). Empty: none.
  std::string positive{};
  /// What is no finite number in a column besides the positions is an error, but for missing ones.
  /// With this it is kept: infinite, or missing where it is no number at all.
  bool lenient = false;
  /// A file with the kinds and the texts of the particles, for files that lack them; empty: none.
  std::string topology{};
  bool places_matter = true;  ///< false: a file without positions is read, they are 0
};

/// A frame that is read part by part: all of it need not fit into memory.
class FrameParts {
 public:
  FrameParts() = default;
  FrameParts(const FrameParts&) = delete;
  FrameParts& operator=(const FrameParts&) = delete;
  virtual ~FrameParts() = default;

  /// Its particles.
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Particles begin .. begin + count - 1, as a frame: with the columns, texts, cell and notes of
  /// the whole one, but without bonds. Precondition: they are there.
  virtual Result<ParticleFrame> read(std::uint64_t begin, std::size_t count) = 0;
};

/// One format's reader of one open file.
class ParticleReader {
 public:
  ParticleReader() = default;
  ParticleReader(const ParticleReader&) = delete;
  ParticleReader& operator=(const ParticleReader&) = delete;
  virtual ~ParticleReader() = default;

  /// How many whole frames the file has, >= 1.
  [[nodiscard]] virtual std::size_t frames() const = 0;

  /// OK if the file ends with a whole frame. Else it was cut off behind these frames: what is wrong
  /// with the next one, a message and a line.
  [[nodiscard]] virtual Status whole() const { return {}; }

  /// Frame `frame`, from 0. The Diagnostic has line, column and, as its key, the column's name
  /// where they are known; its file is set by ParticleFile. Precondition: frame < frames().
  virtual Result<ParticleFrame> read(std::size_t frame, const ParallelFor& parallel_for) = 0;

  /// The same frame part by part; null if this format, or this frame, is read as a whole only.
  virtual Result<std::unique_ptr<FrameParts>> parts(std::size_t frame) {
    static_cast<void>(frame);
    return std::unique_ptr<FrameParts>();
  }
};

}  // namespace boule
