#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/view/messages/view_settings.h"
#include "render/files/scene_file/scene_file.h"

namespace boule::view {

/// A column of numbers of a particle file, and its range.
struct NumberRange {
  std::string name;
  double low = 0, high = 0;
};

/// Frames of a series: first, first + step and so on, up to last.
struct FrameSpan {
  int first = 0, last = 0, step = 1;

  [[nodiscard]] bool holds(int frame) const {
    return frame >= first && frame <= last && (frame - first) % step == 0;
  }
};

/// What a viewed file is, which does not change.
struct SourceFacts {
  std::string path;
  std::string kind;                 ///< "toml", "nff", "spheres", "packed", "particles"
  std::optional<FrameSpan> frames;  ///< none: one picture
  int first_frame = 0;              ///< that is shown first
  bool numbered = false;            ///< each frame has files of its own: so must its pictures
  ParticleLook look;                ///< of a particle file, as the command line says
  std::string shared_options;       ///< of the command line, for a command that shows the same
};

/// Where the scenes come from that are viewed. One thread at a time uses it.
class SceneSource {
 public:
  SceneSource() = default;
  SceneSource(const SceneSource&) = delete;
  SceneSource& operator=(const SceneSource&) = delete;
  virtual ~SceneSource() = default;

  [[nodiscard]] virtual const SourceFacts& facts() const = 0;
  /// Reads the scene of a frame; the look counts for particle files only.
  virtual Result<LoadedScene> load(const ParticleLook& look, int frame) = 0;
  /// The columns of numbers of the particle file as it was read last; empty for others.
  virtual std::vector<NumberRange> columns() = 0;
  /// The options that give a command this look and frame: " --color q --frame 3".
  [[nodiscard]] virtual std::string options_of(const ParticleLook& look, int frame) const = 0;
};

}  // namespace boule::view
