// Particle files of any bytes. The first byte says which format they are read as, and how.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "render/files/particle_file/particle_file.h"
#include "tests/fuzz/input_budget.h"
#include "tests/fuzz/input_folder.h"

namespace {

using namespace boule;
using fuzz::require;

/// Bits 0 to 3: the format, 0: by content. Bit 4: few columns are wanted. Bit 5: names are given.
ParticleFileOptions options_of(std::uint8_t byte) {
  const auto formats = particle_formats();
  ParticleFileOptions options;
  const std::size_t format = byte % 16U % (formats.size() + 1);
  if (format > 0) options.format = formats[format - 1];
  // Python would start each time; libhdf5 is not ours.
  if (options.format == "library" || options.format == "hdf5") options.format.clear();
  if ((byte & 16) != 0) options.wanted = std::vector<std::string>{"radius", "name", "vx"};
  if ((byte & 32) != 0) options.columns = {"id", "type", "x", "y", "z"};
  options.water = (byte & 64) != 0;
  return options;
}

void check_texts(const TextColumn& column, std::size_t size) {
  require(column.indices.size() == size, "a text for each particle: " + column.name);
  for (const std::uint32_t index : column.indices) {
    require(index < column.texts.size(), "indices are of texts: " + column.name);
  }
}

void check_frame(const ParticleFrame& frame) {
  for (const Vec3d& p : frame.positions) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "finite positions");
  }
  for (const NumberColumn& column : frame.numbers) {
    require(column.values.size() == frame.size(), "a number for each particle: " + column.name);
    for (const double value : column.values) {
      require(!std::isinf(value), "numbers are finite or missing: " + column.name);
    }
  }
  for (const TextColumn& column : frame.texts) check_texts(column, frame.size());
  if (frame.species) check_texts(*frame.species, frame.size());
  require(frame.length_in_angstrom > 0, "a unit of length");
  require(!frame.cell || is_finite(*frame.cell), "a cell of finite numbers");
  require(!frame.time || std::isfinite(*frame.time), "a finite time");
}

/// Names for columns that the format names itself: an error about the call, not about the file.
bool is_of_call(const Diagnostic& error) { return error.file.empty() && error.key == "columns"; }

void read_all(const std::string& path, const ParticleFileOptions& options) {
  Result<ParticleFile> file = ParticleFile::open(path, options);
  if (!file) {
    if (!is_of_call(file.error())) fuzz::require_good(file.error());
    return;
  }
  constexpr std::size_t enough = 5;
  const std::size_t frames = file.value().frames();
  require(frames >= 1, "a file has a frame");
  for (std::size_t i = 0; i < std::min(frames, enough); ++i) {
    const auto number = static_cast<long>(i);
    // From both ends.
    const Result<ParticleFrame> frame = file.value().read(i % 2 == 0 ? -1 - number : number);
    if (!frame) {
      fuzz::require_good(frame.error());
    } else {
      check_frame(frame.value());
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::InputBudget budget;
  static const fuzz::InputFolder folder;
  if (size == 0) return 0;
  read_all(folder.write("particles", data + 1, size - 1), options_of(data[0]));
  return 0;
}
