#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/math/srgb.h"
#include "core/scene/names.h"
#include "render/files/particles/colors/color_map.h"
#include "render/files/particles/colors/given_kinds.h"
#include "render/files/particles/particle_choices.h"
#include "render/files/particles/particle_labels.h"

namespace boule {

/// The tables of radii by element: van der Waals (S. Alvarez, Dalton Trans. 42, 8617, 2013),
/// covalent (B. Cordero et al., Dalton Trans., 2832, 2008) and ionic (IonicRadius).
enum class RadiusTable { vdw, covalent, ionic };
template <>
inline constexpr std::array<std::string_view, 3> names<RadiusTable>{"vdw", "covalent", "ionic"};

/// The column that holds every particle's radius.
struct RadiusColumn {
  std::string name;
};

/// What a particle's radius is, in the units of the file. Nothing: the column "radius" if there is
/// one, else half of "diameter", else van der Waals if most particles are elements, else half the
/// typical distance to the nearest neighbour, of all particles, those that are not shown too. A
/// table gives that distance to species it lacks, and a note.
using RadiusRule = std::variant<std::monostate, double, RadiusColumn, RadiusTable>;

/// Colours of the species: elements as in Jmol's table, others from a qualitative palette.
struct SpeciesColors {};

/// Columns that hold a colour each: one of texts "#rrggbb", or three of numbers from 0 to 1 on the
/// sRGB curve (or, with a note, whole ones to 255). One column may also be of numbers, or "|NAME|":
/// then it is MappedColors by it, unless its numbers are few and whole, as types are
/// (most_kinds()): those are like texts. If it is the species', they are SpeciesColors; other
/// texts, such as names of residues, have a colour of the palette each.
struct ColorColumns {
  /// One or three. One name of three words, where no column has it, is the names of three columns.
  std::vector<std::string> names;
};

/// The three names that a text is, "red green blue"; none if it has fewer words or more.
std::vector<std::string> three_names(const std::string& text);

/// The colour map's colour of a number of each particle.
struct MappedColors {
  /// A column, "x", "y" or "z", or "|NAME|": the norm of columns NAMEx NAMEy NAMEz, or NAME_x ...
  std::string by;
  ColorMap map{};
  /// What the map's ends stand for, least < largest; none: the 1st to 99th percentile of the
  /// particles that are shown, which a note tells.
  std::optional<std::array<double, 2>> range{};
};

/// A vector at each particle, from its centre.
struct ArrowColumns {
  /// Three columns of numbers, or the name that three have before x, y, z or _x, _y, _z.
  std::vector<std::string> names;
  double scale = 1;  ///< times the vectors; > 0
};

/// What a particle's colour is. Nothing: columns "color" or "red", "green", "blue" if there are
/// some, else species if there are any, else the material's own.
using ColorRule =
    std::variant<std::monostate, SrgbColor, SpeciesColors, ColorColumns, MappedColors>;

/// What particles are drawn as: spheres that fill space, small ones with bonds between them, or
/// bonds with ends as thick as they are.
enum class ParticleShape { space_filling, balls_and_sticks, sticks };
template <>
inline constexpr std::array<std::string_view, 3> names<ParticleShape>{"space-filling",
                                                                      "balls-and-sticks", "sticks"};

/// Which particles are bonded: those that the file lists; those whose distance is below the sum of
/// their covalent radii and 0.4 angstrom; those whose spheres overlap; none. Automatic: what the
/// file lists, if it lists all; else also those by distance, but for two particles whose bonds it
/// lists.
enum class BondRule { automatic, file, distance, contacts, none };
template <>
inline constexpr std::array<std::string_view, 5> names<BondRule>{"auto", "file", "distance",
                                                                 "contacts", "none"};

/// A rule, or the distance below which particles are bonded, > 0. Nothing: automatic if bonds are
/// drawn, else none.
using BondChoice = std::variant<std::monostate, BondRule, double>;

/// What outlines of particles go around: each of them, all that is near what is before it, one
/// kind, molecule, chain or residue. Molecules are those of the column "mol", else what is bonded.
enum class OutlineRule { object, depth, kind, molecule, chain, residue };
template <>
inline constexpr std::array<std::string_view, 6> names<OutlineRule>{"object",   "depth", "kind",
                                                                    "molecule", "chain", "residue"};

/// A rule, or a column whose numbers or texts are the groups. Nothing: depth for sticks, else
/// object.
using OutlineChoice = std::variant<std::monostate, OutlineRule, std::string>;

/// How the particles of a frame become spheres: what [[particles]] says.
struct ParticleStyle {
  RadiusRule radius{};
  double scale = 1;                 ///< the radii times that, > 0
  std::vector<KindRadius> radii{};  ///< of species, in place of the rule's, before the scale
  ColorRule color{};
  std::vector<KindColor> colors{};      ///< in place of those that the rule gives to kinds
  SrgbColor nan_color = missing_color;  ///< of what has no number, or no text
  /// Kinds that are named above may be absent, as they may be in a frame of a series.
  bool lacks_kinds = false;
  /// Of a series: what all its frames choose; null: the frame chooses by itself. A view.
  const ParticleChoices* chosen = nullptr;
  /// The index of the spheres' material; below MaterialRef::max_colored, unless they keep its
  /// colour.
  std::uint32_t material = 0;
  /// Nothing: balls and sticks if `bonds` is a rule, or if no radii are given and the file lists
  /// bonds for most of at most 1000 particles; else spheres that fill space.
  std::optional<ParticleShape> shape{};
  BondChoice bonds{};
  std::optional<double> bond_radius{};    ///< > 0; nothing: one that fits the shape
  std::optional<SrgbColor> bond_color{};  ///< nothing: half bonds have their particles' colours
  bool cell_edges = false;                ///< are drawn
  bool axes = false;                      ///< are drawn, from a corner
  std::optional<ArrowColumns> arrows{};
  OutlineChoice outline_by{};
  /// Which particles: "type == 1 && x > 0", 'species == "Fe"' (SelectExpression); empty: all.
  std::string select{};
  LabelRule labels{};   ///< of those that are shown
  std::string ghost{};  ///< which of those that are shown are ghosts; empty: none
  /// The index of the material of ghosts, below MaterialRef::max_colored.
  std::uint32_t ghost_material = 0;
  bool wrap = false;      ///< into the cell, along its periodic directions
  bool unwrap = false;    ///< what is bonded through a face is moved together
  bool boundary = false;  ///< with the images of particles on faces that are on opposite faces
  std::array<int, 3> replicate{1, 1, 1};  ///< periodic images along a, b, c, >= 1 each
};

/// The columns that tell the groups of a rule, as far as a file has them.
std::vector<std::string> outline_columns(OutlineRule rule);

/// The columns that the style reads besides positions and species, for
/// ParticleFileOptions::wanted. Those it would take by default are among them.
std::vector<std::string> columns_of(const ParticleStyle& style);

}  // namespace boule
