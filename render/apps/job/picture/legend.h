#pragma once

#include <string>
#include <vector>

#include "render/files/particles/colors/color_meaning.h"
#include "render/files/scene_file/loaded/particle_facts.h"

namespace boule {

/// What the colours of a picture mean, as an SVG file to be put beside it: a bar with ticks for
/// each map of numbers, and a list for each set of species. Empty if the colours mean neither.
std::string legend_svg(const std::vector<ParticleColors>& colors);
bool has_legend(const std::vector<ParticleColors>& colors);
/// The colours of these tables.
std::vector<ParticleColors> colors_of(const std::vector<ParticleFacts>& particles);

/// The numbers of the ticks of an axis: some of the multiples of 1, 2 or 5 times a power of ten
/// that lie within low .. high, four to ten of them where doubles are fine enough.
/// Precondition: low < high, both finite.
std::vector<double> ticks_within(double low, double high);

/// A number of a legend's axis, and how it is written.
struct LegendTick {
  double number;
  std::string text;
};
/// Those of an axis. Precondition: as of ticks_within().
std::vector<LegendTick> legend_ticks(double low, double high);

/// The list of a legend: the kinds, or below a bar what has no number. A kind without a name is
/// "missing".
std::vector<ParticleColors::Species> legend_rows(const ParticleColors& colors);

/// "bfactor (\u00c5\u00b2)": what stands above a bar.
std::string legend_title(const ParticleColors::Scale& scale);

/// Text as XML has it. Precondition: it has only characters that XML can have.
std::string xml_text(const std::string& text);

}  // namespace boule
