#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "render/apps/job/particle_look.h"

namespace boule {

/// A finite number above 0.
std::optional<double> parse_above_0(const std::string& text);

/// One of particle_formats(), and the list of them.
std::optional<std::string> parse_particle_format(const std::string& text);
std::string list_particle_formats();

/// Any text but an empty one.
std::optional<std::string> parse_words(const std::string& text);
/// The name of an SVG file, by its ending.
std::optional<std::string> parse_svg_name(const std::string& text);

/// Names with commas between them, none of them empty.
std::optional<std::vector<std::string>> parse_names(const std::string& text);

/// A radius of particles: any text but an empty one and a number that is not above 0.
std::optional<std::string> parse_radius(const std::string& text);

/// A name of BondRule, or a number above 0.
std::optional<std::string> parse_bonds(const std::string& text);
std::string list_bond_rules();

/// The names of OutlineRule.
std::string list_outline_rules();

/// Three names of columns, or one that they have before x, y, z.
std::optional<std::vector<std::string>> parse_arrows(const std::string& text);

/// Colours of particles: any text but an empty one and "#..." that is no colour.
std::optional<std::string> parse_particle_color(const std::string& text);

/// True if these colours of particles are a column, whose numbers a map turns into colours. Three
/// words are the names of three columns, unless the file has one of that name.
bool has_color_map(const std::string& color);

/// True if they may be such a column, as three words may: it shows when the file is read.
bool may_have_color_map(const std::string& color);

/// A map of colours: named_color_map(), or colours (parse_color()) with commas between them.
std::optional<std::string> parse_map(const std::string& text);
std::string list_color_maps();

/// A colour: parse_color().
std::optional<std::string> parse_one_color(const std::string& text);

/// "O=crimson,7=#336699": a colour for each kind, and "Na=1.02,Cl=1.81": a radius for each, a
/// finite number above 0. Each kind once.
std::optional<std::vector<KindText>> parse_kind_colors(const std::string& text);
std::optional<std::vector<KindText>> parse_kind_radii(const std::string& text);

/// "2x2x1": three whole numbers from 1 on.
std::optional<std::array<int, 3>> parse_replicate(const std::string& text);

/// "x<5;1,1,0>=2": half-spaces, each by an axis or the components of a vector, < or >, and a
/// number. The planes that leave them.
std::optional<std::vector<ClipChoice>> parse_clip(const std::string& text);

/// What is probably meant where the text is not understood: "; did you mean 'viridis'?", or
/// nothing. Of formats of particle files, of rules for bonds, of maps, of a colour, and of colours
/// of kinds.
std::string hint_format(const std::string& text);
std::string hint_bonds(const std::string& text);
std::string hint_map(const std::string& text);
std::string hint_color(const std::string& text);
std::string hint_kind_colors(const std::string& text);

/// "A,B" with A < B, both finite.
std::optional<std::array<double, 2>> parse_range(const std::string& text);

/// "x", "-x", "y", "-y", "z", "-z", "iso", which is "-1,-1,-1", or "X,Y,Z": a vector that is not
/// zero, as float too.
std::optional<Vec3d> parse_direction(const std::string& text);

/// The same, or the name of a pose; and what is probably meant by other text.
std::optional<ViewChoice> parse_view(const std::string& text);
std::string hint_view(const std::string& text);

}  // namespace boule
