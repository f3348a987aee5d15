#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/colors/color_meaning.h"
#include "render/files/particles/particle_choices.h"
#include "render/files/particles/particle_labels.h"

namespace boule {

/// The facts about one table of a scene, [[particles]] or a [[spheres]] with colours: for `boule
/// info` and for legends.
struct ParticleFacts {
  std::string table{};           ///< its path in the scene file: "particles[0]", "spheres[2]"
  std::string file{};            ///< as LoadedScene::data_files
  std::string format{};          ///< a name of particle_formats(): "xyz"
  std::size_t frames = 1;        ///< number of frames in the file
  std::size_t frame = 0;         ///< the frame that was read, from 0
  std::optional<double> time{};  ///< of that frame, if the file has it
  std::size_t particles = 0;     ///< in that frame
  std::size_t spheres = 0;       ///< number of shown spheres, periodic images included
  std::size_t bonds = 0;         ///< of the shown particles, without those of images
  std::string radius_source{};   ///< as ParticleSpheres
  ParticleColors colors{};
  std::vector<ParticleLabel> labels{};
  std::optional<ParticleCell> cell{};
  bool axes_matter = true;  ///< as ParticleSpheres
  ParticleChoices own{};    ///< what the frame by itself has for what is chosen
};

/// The choices of all frames of a series, by ParticleFacts::table.
using SeriesChoices = std::map<std::string, ParticleChoices>;

/// The choices for a table, or null.
inline const ParticleChoices* find_choices(const SeriesChoices& all, const std::string& table) {
  const auto found = all.find(table);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace boule
