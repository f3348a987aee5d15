#pragma once

#include <string>
#include <vector>

namespace boule::test {

/// A scene whose noise is measured: one of the gallery, or a text.
struct NoiseScene {
  std::string name;
  std::string text;   ///< TOML; empty: scenes/NAME.toml
  bool path = false;  ///< path-traced, whatever the scene says
  /// Light that paths meet by chance alone, once in thousands: no interval of few samples holds.
  bool chance = false;
};

/// Twenty-odd scenes: what the gallery shows, and what is hard, since it is bright and rare.
std::vector<NoiseScene> noise_scenes();

}  // namespace boule::test
