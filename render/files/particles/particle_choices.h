#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "render/files/particles/colors/color_meaning.h"
#include "render/files/particles/colors/given_kinds.h"

namespace boule {

/// How many different whole numbers a column may have to be kinds, at least 2; one whose name says
/// that it has kinds (type, mol, cluster) may have one, and many more.
std::size_t most_kinds(const std::string& column);

/// What is chosen for particles where nobody says it, and what it is chosen from: of one frame, or
/// of all frames of a series together (add()), which then choose the same.
struct ParticleChoices {
  /// Those that are elements, of the particles: whether radii are van der Waals'.
  std::size_t elements = 0, particles = 0;
  /// Whether all make a salt or an oxide (is_salt()), whose radii are ionic where nobody says it;
  /// in a series, whether all frames with particles are such.
  std::optional<bool> are_ionic{};
  /// The typical distance to the nearest neighbour, in a series the smallest; none where radii do
  /// not need it, or no two particles differ.
  std::optional<double> distance{};
  /// The species that the table of radii lacks.
  std::vector<std::string> unlisted{};
  bool radii_differ = false;  ///< of a series: frames by themselves would choose other radii

  /// The 1st and 99th percentile of the numbers that have a colour map and no range; in a series
  /// the lowest and the highest of them.
  std::optional<std::array<double, 2>> range{};
  /// The numbers of `column`, in their order, if all are whole and they are few; else none.
  std::optional<std::vector<double>> kind_numbers{};
  std::string column{};      ///< of numbers, if colours come from one by itself
  bool are_species = false;  ///< the kinds are species
  /// The texts of the column that colours come from, in the order in which they occur; the count is
  /// 0 where none of their particles are shown. Those of numbers come when all are added.
  std::vector<ParticleColors::Species> kinds{};
  std::vector<KindColor> given{};       ///< as ParticleStyle::colors
  SrgbColor nan_color = missing_color;  ///< as ParticleStyle
  std::optional<SrgbColor> all{};       ///< of the kinds for which nothing is given

  /// Whether balls and sticks are drawn where nobody says it; in a series, whether all frames with
  /// particles are of such.
  std::optional<bool> starts_bonded{};
  /// Of the particles, where radii of bonds come from it; in a series of all frames.
  std::optional<double> smallest_radius{};
  /// The box around the spheres, where axes are drawn; in a series around those of all frames.
  std::optional<std::array<Vec3d, 2>> axes_box{};

  std::string of_frames{};  ///< "all 4 frames"; empty: one frame by itself

  /// Adds another frame of the same series.
  void add(const ParticleChoices& frame);
  /// Chooses the kinds and their colours, once so many frames are added ("all 4 frames").
  void finish(const std::string& frames);

  [[nodiscard]] bool most_are_elements() const { return elements > particles / 2; }
  /// Whether the column's numbers are kinds.
  [[nodiscard]] bool numbers_are_kinds() const;
  /// Whether other frames may change what is chosen.
  [[nodiscard]] bool is_open() const {
    return particles > 0 || distance || range || !column.empty() || !kinds.empty() || axes_box;
  }
  /// The radius where there is no other: half the typical distance, or 1.
  [[nodiscard]] double typical_radius() const { return distance ? *distance / 2 : 1; }
};

/// The numbers, in their order, that a column has if all are whole and so few: else none.
std::optional<std::vector<double>> find_kinds(const std::vector<double>& numbers, std::size_t most);
/// "1" for 1.
std::string kind_text(double kind);

/// The range of a colour map that these ends, at most equal, ask for: around what is one number.
std::array<double, 2> map_range(const std::array<double, 2>& ends);

/// "the colours of 'v' go from 0 to 3, the 1st and 99th percentile": the note of a chosen range.
std::string range_note(const std::string& by, const std::array<double, 2>& ends,
                       const std::string& of_frames = {});

}  // namespace boule
