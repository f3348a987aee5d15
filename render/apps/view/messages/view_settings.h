#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/names.h"
#include "core/scene/scene.h"
#include "render/frame/pixel_order.h"
#include "render/renderer/run_statistics.h"
#include "simd/abi/isa.h"

namespace boule::view {

/// How one pane renders.
struct PaneSettings {
  PixelOrder order = PixelOrder::progressive;
  Solver solver = Solver::robust;
  Method method = Method::whitted;
  std::optional<float> shadow_epsilon{};  ///< as RenderOptions

  friend bool operator==(const PaneSettings&, const PaneSettings&) = default;
};

/// What a third picture shows of two panes: nothing, how far their colours are apart, or their
/// primary rays' t.
enum class Difference { none, color, ulp };

/// All that a client chooses, but the camera.
struct ViewSettings {
  std::vector<PaneSettings> panes = std::vector<PaneSettings>(1);  ///< one or two
  Difference difference = Difference::none;
  int width = 1280, height = 720;  ///< of the full picture, 1 .. max_view_side
  int spp = 1;                     ///< 1 .. max_view_spp
  int max_depth = 5;               ///< 0 .. max_view_depth
  float exposure = 0;              ///< stops, -100 .. 100
  float outline = 0;               ///< width of lines in pixels, 0 .. 100
  float fog = 0;                   ///< as RenderOptions, 0 .. 1
  double pace = 0;                 ///< pixels a second in each pane; 0: all it can

  friend bool operator==(const ViewSettings&, const ViewSettings&) = default;
};

inline constexpr int max_view_side = 4096;
inline constexpr int max_view_spp = 65536;
inline constexpr int max_view_depth = 1000;
inline constexpr double min_pace = 1000, max_pace = 1e9;

/// What a client chooses of how a particle file looks. Empty: as the file asks for.
struct ParticleLook {
  std::string color, map;
  std::optional<std::array<double, 2>> range{};  ///< none: from the data
  std::string ghost{};                           ///< which particles are ghosts
  std::optional<double> opacity{};               ///< of ghosts, 0 .. 1
  std::string outline_by{};                      ///< what lines go around

  friend bool operator==(const ParticleLook&, const ParticleLook&) = default;
};

}  // namespace boule::view

namespace boule {

template <>
inline constexpr std::array<std::string_view, 3> names<view::Difference>{"none", "color", "ulp"};

}  // namespace boule
