#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/optics/camera_view.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "render/files/particles/colors/color_meaning.h"
#include "render/files/scene_file/loaded/particle_facts.h"

namespace boule {

/// "legend,scale", or "none"; and what is probably meant by other text.
std::optional<OverlayParts> parse_overlay(const std::string& text);
std::string hint_overlay(const std::string& text);
std::string list_overlay_parts();

/// The text of a particle.
struct OverlayLabel {
  double x = 0, y = 0;  ///< of its middle, in pixels from the upper left corner
  double radius = 0;    ///< in pixels
  double depth = 0;     ///< along the view
  double sphere = 0;    ///< its radius in the scene
  std::string text{};
};

/// What an overlay tells of a picture.
struct OverlayFacts {
  OverlayParts parts{};
  std::vector<ParticleColors> colors{};
  std::vector<OverlayLabel> labels{};  ///< the nearest first
  std::array<Vec3d, 3> axes{};  ///< x, y, z as the camera sees them: right, up, towards the viewer
  /// Pixels of a length of 1, at the depth of the point that the camera looks at; none: the camera
  /// bends straight lines.
  std::optional<double> pixels_per_length{};
  std::string unit{};  ///< of lengths: "Å", "nm"; empty: unknown
  std::string time{};  ///< "t = 12.5", "frame 3"; empty: there is neither
  double pixels_per_point = 300.0 / 72;

  [[nodiscard]] bool has(OverlayPart part) const;
  [[nodiscard]] bool is_empty() const { return parts.empty() && labels.empty(); }
};

/// Of these tables of particles, whose colours mean `colors`. `frame`: that of a series.
OverlayFacts overlay_facts(const OverlayParts& parts, const std::vector<ParticleFacts>& particles,
                           std::vector<ParticleColors> colors, const std::optional<double>& frame);

/// Adds what the camera of a picture `width` pixels wide tells.
void add_camera(const Camera& camera, const CameraView& view, int width, OverlayFacts& facts);

/// Which of the parts have nothing to tell, a sentence each; and that a scale bar is right at one
/// depth only.
std::vector<std::string> overlay_notes(const OverlayFacts& facts, const CameraView& view);

}  // namespace boule
