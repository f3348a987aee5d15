#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/particle_file/particle_frame.h"
#include "render/particles/color_meaning.h"

namespace boule {

/// What was read for one table of a scene, [[particles]] or a [[spheres]] with colours: for
/// `boule info` and for legends.
struct ParticleFacts {
  std::string table{};           ///< its path in the scene file: "particles[0]", "spheres[2]"
  std::string file{};            ///< as LoadedScene::data_files
  std::string format{};          ///< a name of particle_formats(): "xyz"
  std::size_t frames = 1;        ///< in the file
  std::size_t frame = 0;         ///< that was read, from 0
  std::optional<double> time{};  ///< of that frame, if the file tells it
  std::size_t particles = 0;     ///< in that frame
  std::size_t spheres = 0;       ///< that are shown, periodic images included
  std::string radius_source{};   ///< as ParticleSpheres
  ParticleColors colors{};
  std::optional<ParticleCell> cell{};
};

/// The numbers that the ends of colour maps stand for, by ParticleFacts::table.
using ColorRanges = std::map<std::string, std::array<double, 2>>;

/// The colours of species and other texts, by ParticleFacts::table.
using KindColors = std::map<std::string, std::vector<ParticleColors::Species>>;

/// Keeps the colours that were chosen: with them as SceneFileOptions::color_ranges and kind_colors,
/// the other frames of a series have the colours of this one. What is known already stays, and so
/// does how a table is coloured that was shown; one that shows nothing chooses nothing.
inline void keep_colors(const std::vector<ParticleFacts>& all, ColorRanges& ranges,
                        KindColors& kinds) {
  for (const ParticleFacts& facts : all) {
    if (facts.spheres == 0) continue;
    const auto [known, is_new] = kinds.try_emplace(facts.table);
    if (is_new && facts.colors.scale) ranges.emplace(facts.table, facts.colors.scale->range);
    auto& species = known->second;
    for (const ParticleColors::Species& one : facts.colors.species) {
      const bool is_known = std::any_of(species.begin(), species.end(),
                                        [&](const auto& kind) { return kind.name == one.name; });
      if (!is_known) species.push_back(one);
    }
  }
}

}  // namespace boule
