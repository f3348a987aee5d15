#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// In place of a particle's number: there is none.
inline constexpr std::size_t no_particle = std::numeric_limits<std::size_t>::max();

/// A number of each particle, of whatever a frame has. It is a view: the frame outlives it.
class ParticleNumbers {
 public:
  /// The same number for all.
  explicit ParticleNumbers(double value) : constant_(value) {}
  /// A column, or an axis of the positions: `stride` numbers from one particle to the next.
  ParticleNumbers(const double* first, std::size_t stride) : first_{first}, stride_(stride) {}
  /// The norm of three columns. Where it is too large for a number, the largest.
  explicit ParticleNumbers(const std::array<const double*, 3>& columns)
      : first_(columns), stride_(1) {}
  /// Texts that are numbers, all of them.
  ParticleNumbers(const TextColumn& texts, std::vector<double> values)
      : indices_(texts.indices.data()), values_(std::move(values)) {}

  /// The numbers of particles begin .. end - 1, to `numbers`.
  void read(std::size_t begin, std::size_t end, double* numbers) const;

  /// The number of one particle.
  [[nodiscard]] double at(std::size_t particle) const;

 private:
  double constant_ = 0;
  std::array<const double*, 3> first_{};
  std::size_t stride_ = 1;
  const std::uint32_t* indices_ = nullptr;
  std::vector<double> values_;
};

/// The numbers with this name: a column, "x", "y" or "z" of the positions, "|NAME|" for the norm of
/// NAMEx, NAMEy, NAMEz or NAME_x, NAME_y, NAME_z, or texts that are all numbers, such as types. An
/// error, about `key`, for other texts and for a name that is not there; it tells what is meant.
Result<ParticleNumbers> find_particle_numbers(const ParticleFrame& frame, const std::string& name,
                                              const std::string& key);

/// The texts with this name: a column, or the species by its name, "species" or "element". Null if
/// there is none.
const TextColumn* find_particle_texts(const ParticleFrame& frame, const std::string& name);

/// "there is no column 'vs'; did you mean 'vz'?", about `key`.
Diagnostic no_such_column(const ParticleFrame& frame, const std::string& name,
                          const std::string& key);

/// NAME if `text` is "|NAME|", else nothing.
std::string_view norm_name(std::string_view text);

/// Adds the columns that find_particle_numbers() would look at for this name.
void add_column_names(const std::string& name, std::vector<std::string>& names);

/// "particle 3 of 10", for messages; `particle` counts from 0, the text from 1. `part`: of a frame
/// of which this is a part.
std::string particle_text(std::size_t particle, std::size_t count,
                          const std::optional<ParticleFrame::Part>& part = {});

/// What messages call a particle, by its place in a frame.
using ParticleNamer = std::function<std::string(std::size_t particle)>;

}  // namespace boule
