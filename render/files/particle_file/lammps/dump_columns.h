#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particle_file/frame/particle_reader.h"
#include "render/files/particle_file/text/named_columns.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {

/// The columns of a frame of a dump, and what they become. The position of each axis is x, else xs
/// (a fraction of the box), else xu (unwrapped), else xsu.
class DumpColumns {
 public:
  /// The columns' names, and the words of the first row. `read`, which has its cell already, gets
  /// them.
  DumpColumns(const std::vector<std::string>& names, std::span<const std::string_view> examples,
              const ParticleFileOptions& options, ParticleFrame& read);

  /// An error at line `names_line` unless there is one position for each axis.
  [[nodiscard]] Status check(std::uint64_t names_line) const;
  /// What the rows are to fill.
  [[nodiscard]] std::span<const TextRowColumn> columns() const { return columns_.columns(); }
  /// When they have: makes positions of fractions, sorts the particles by their ids, and takes
  /// types as species. `first_line` is that of the first row; 0: it has none.
  Status finish(std::uint64_t first_line, const ParallelFor& parallel_for);

  /// All of this for rows of text.
  Status read(const TextRows& rows, std::uint64_t names_line, const ParallelFor& parallel_for);

 private:
  [[nodiscard]] bool any_scaled() const { return scaled_[0] || scaled_[1] || scaled_[2]; }
  [[nodiscard]] bool all_scaled() const { return scaled_[0] && scaled_[1] && scaled_[2]; }
  void find_positions(const std::vector<std::string>& names);
  [[nodiscard]] Status check_scaled() const;
  void unscale();

  ParticleFrame& read_;
  NamedColumns columns_;
  std::array<std::string, 3> names_;  ///< of the positions
  std::array<bool, 3> scaled_{};
};

}  // namespace boule
