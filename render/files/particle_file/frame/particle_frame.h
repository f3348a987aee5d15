#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace boule {

/// The parallelepiped of a simulation: the points origin + x a + y b + z c with x, y, z in [0, 1].
struct ParticleCell {
  Vec3d a{}, b{}, c{};
  Vec3d origin{};
  std::array<bool, 3> periodic{};  ///< along a, b, c
};

/// True if all of the cell's numbers are finite.
bool is_finite(const ParticleCell& cell);

/// A number of every particle, under its name in the file; whole numbers are exact up to 2^53. NaN
/// stands for a missing one.
struct NumberColumn {
  std::string name{};
  std::vector<double> values{};  ///< by particle
};

/// The extent of a column's numbers.
struct ColumnExtent {
  double least = 0,
         largest = 0;  ///< of the finite ones; least > largest if all are missing or infinite
  std::size_t missing = 0, infinite = 0;
};
ColumnExtent column_extent(const NumberColumn& column);

/// A text of every particle, such as the name of a residue: an index into the list of different
/// texts.
struct TextColumn {
  std::string name{};
  std::vector<std::string> texts{};      ///< in the order of their first use
  std::vector<std::uint32_t> indices{};  ///< by particle
};

/// Two particles with a bond, by their places in the frame.
struct ParticleBond {
  std::uint32_t a = 0, b = 0;

  friend bool operator==(const ParticleBond& p, const ParticleBond& q) {
    return p.a == q.a && p.b == q.b;
  }
  friend bool operator<(const ParticleBond& p, const ParticleBond& q) {
    return p.a != q.a ? p.a < q.a : p.b < q.b;
  }
};

/// One frame of a particle file, in the units of the file (lengths of GROMACS files: nm). All
/// lists by particle have as many entries as `positions`, which are finite. So are all numbers that
/// are there, unless the file was read with ParticleFileOptions::lenient.
struct ParticleFrame {
  std::vector<Vec3d> positions{};
  /// The particles' kinds: elements ("C", "Fe") if the file has them, otherwise types ("1"). Empty
  /// if it has neither.
  std::optional<TextColumn> species{};
  std::vector<NumberColumn> numbers{};  ///< in the order of the file, without the positions
  std::vector<TextColumn> texts{};      ///< likewise, without the species
  /// The names of columns that the file has and that were not requested, for messages about similar
  /// names.
  std::vector<std::string> unread{};
  /// Those that the file has, if they are asked for: in order, each once, a < b.
  std::vector<ParticleBond> bonds{};
  /// What is not among `bonds` is no bond. False where files list some only, such as those of
  /// ligands.
  bool lists_all_bonds = false;
  std::optional<ParticleCell> cell{};
  /// False if the axes of coordinates are arbitrary, as those of a molecule by itself are.
  bool axes_matter = true;
  std::optional<double> time{};
  /// The file's unit of length in angstrom (10 for nm); 1 if it is unknown. Tables of radii need
  /// it.
  double length_in_angstrom = 1;
  std::vector<std::string> notes{};  ///< omissions and automatic choices, a sentence each
  /// Of a part of a frame: how many particles are before it, and how many the whole frame has.
  struct Part {
    std::uint64_t before, all;
  };
  std::optional<Part> part{};

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// The column of this name, or null.
const NumberColumn* find_number_column(const ParticleFrame& frame, const std::string& name);
const TextColumn* find_text_column(const ParticleFrame& frame, const std::string& name);

/// The unit of a column, or of x, y, z, where the format of the file says it: "\u00c5", "nm/ps".
/// Empty: it is unknown.
std::string column_unit(std::string_view format, std::string_view column);

/// Puts bonds in order: a < b in each, each once, none of a particle with itself.
void put_in_order(std::vector<ParticleBond>& bonds);

/// Drops the bonds of particles that are not kept, which have 0 in `kept`, and numbers those of the
/// others by their places among these.
void keep_bonds(std::vector<ParticleBond>& bonds, const std::vector<std::uint8_t>& kept);

/// Whether a column can have this name, which neither positions nor another column have.
bool is_free_name(const ParticleFrame& frame, const std::string& name);

/// Whether a column is to be read: all are if `wanted` is empty.
bool is_wanted(const std::optional<std::vector<std::string>>& wanted, std::string_view name);

/// Moves the names of texts that are not wanted to the list of those that are unread.
void leave_out_unwanted(const std::optional<std::vector<std::string>>& wanted,
                        ParticleFrame& frame);

}  // namespace boule
