#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particle_file/frame/particle_reader.h"
#include "render/files/particle_file/hdf5/hdf5_file.h"

namespace boule {

/// Numbers of consecutive particles, as many of each: those of a dataset, or one for all.
struct Hdf5Numbers {
  std::string path{};  ///< empty: all are `value`
  double value = std::numeric_limits<double>::quiet_NaN();
  std::optional<std::uint64_t> frame{};  ///< of the dataset's first axis; none: it has no such axis
  bool has_rows = false;                 ///< its last axis is that of a particle's numbers
};

/// The centres of a part's particles: rows of three numbers, or axes that have datasets of their
/// own. Each is the number plus its offset times the factor.
struct Hdf5Places {
  std::vector<Hdf5Numbers> axes{};     ///< one with rows, or three
  std::vector<Hdf5Numbers> offsets{};  ///< three, or none
  std::array<double, 3> factors{};
};

/// Columns of numbers that a frame reads together.
struct Hdf5Array {
  std::vector<std::string> names{};
  std::vector<Hdf5Numbers> parts{};  ///< of each part of the frame
};

/// A column of texts; of codes, their names; of whole numbers, their digits.
struct Hdf5Texts {
  std::string name{};
  std::string path{};
  std::optional<std::uint64_t> frame{};
  Hdf5Kind kind = Hdf5Kind::texts;
};

/// Where a frame's particles are in a file.
struct Hdf5Layout {
  /// Particles that stand together, such as gas and stars.
  struct Part {
    std::string kind{};  ///< its species, if parts are species
    std::uint64_t count = 0;
    Hdf5Places places{};
  };
  std::vector<Part> parts{};
  std::string species_name{};  ///< of the column of the parts' kinds; empty: they are no species
  std::optional<Hdf5Texts> species{};  ///< of a frame of one part
  std::vector<Hdf5Array> arrays{};
  std::vector<Hdf5Texts> texts{};  ///< of a frame of one part
  ParticleFrame facts{};           ///< all that is no list by particle

  [[nodiscard]] std::uint64_t count() const {
    std::uint64_t all = 0;
    for (const Part& part : parts) all += part.count;
    return all;
  }
};

/// How a family of programs arranges particles in files of HDF5.
class Hdf5Family {
 public:
  explicit Hdf5Family(const Hdf5File& file) : file_(file) {}
  Hdf5Family(const Hdf5Family&) = delete;
  Hdf5Family& operator=(const Hdf5Family&) = delete;
  virtual ~Hdf5Family() = default;

  [[nodiscard]] virtual std::size_t frames() const = 0;
  /// Of the columns, `options.wanted`.
  virtual Result<Hdf5Layout> layout(std::size_t frame,
                                    const ParticleFileOptions& options) const = 0;

 protected:
  const Hdf5File& file_;
};

using Hdf5Opened = Result<std::unique_ptr<Hdf5Family>>;

/// H5MD: the first group of particles that has positions.
Hdf5Opened open_h5md(const Hdf5File& file);
/// Snapshots of GADGET and its family: all types of particles, in their order. Null if the file is
/// none.
Hdf5Opened open_snapshot(const Hdf5File& file);
/// openPMD: all species of particles; steps are frames, lengths are in the unit of the positions.
/// Null if the file is none.
Hdf5Opened open_openpmd(const Hdf5File& file);

inline bool are_numbers(const Hdf5Object& object) {
  return object.kind == Hdf5Kind::integers || object.kind == Hdf5Kind::floats ||
         object.kind == Hdf5Kind::codes;
}

/// The names of the columns of an array with so many numbers a particle.
std::vector<std::string> hdf5_column_names(const std::string& name, std::uint64_t width);

/// Adds an array if one of its columns is wanted; else their names are known.
void add_array(Hdf5Array array, const ParticleFileOptions& options, Hdf5Layout& layout);

/// Says that something is not read, and why.
void leave_out(const std::string& name, const std::string& why, Hdf5Layout& layout);

/// A cell of these edges, if they span one.
void set_cell(const std::array<Vec3d, 3>& edges, const std::array<bool, 3>& periodic,
              ParticleFrame& frame);

}  // namespace boule
