#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/math/srgb.h"
#include "core/scene/scene.h"
#include "render/apps/job/overlay/overlay_facts.h"
#include "render/apps/job/particle_look.h"
#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"
#include "render/renderer/aov_channels.h"
#include "render/renderer/render_options.h"
#include "simd/abi/isa.h"

namespace boule {

/// Width and height in pixels.
struct Size {
  int width, height;
};

/// The pixels of a picture, as far as they are asked for: by their number, or by the size in print.
struct SizeChoice {
  std::optional<Size> shape{};    ///< without a width in print the pixels, else their ratio
  std::optional<double> width{};  ///< in print, mm
  std::optional<double> dpi{};    ///< pixels per inch

  static constexpr double usual_dpi = 300;

  [[nodiscard]] bool is_printed() const { return width || dpi; }
  [[nodiscard]] double pixels_per_inch() const { return dpi.value_or(usual_dpi); }
  /// What is not asked for comes from the scene. A side may be too large for a picture.
  [[nodiscard]] Size of(const ImageSettings& image) const;
};

/// How wide the outlines are.
struct OutlineWidth {
  float width = 0;         ///< pixels, or points
  bool in_points = false;  ///< 72 of them are an inch

  friend bool operator==(const OutlineWidth&, const OutlineWidth&) = default;
};

/// The background that is asked for: a colour, or none at all.
struct BackgroundChoice {
  std::optional<SrgbColor> color;  ///< none: transparent
};

/// Frames of a series: first, first + step and so on, up to last.
struct FrameRange {
  int first, last;
  int step = 1;  ///< >= 1

  /// How many they are.
  [[nodiscard]] int count() const { return (last - first) / step + 1; }
};

/// Which scene is read, and on what it is worked with.
struct SceneJob {
  std::string scene{};  ///< the file
  LookOptions look{};   ///< of a particle file
  PolygonPolicy polygons = PolygonPolicy::plane;
  bool trust = false;    ///< packed scenes are left unchecked
  unsigned threads = 0;  ///< at most max_threads; 0: all
  std::string isa = "auto";
  Solver solver = Solver::robust;
};

inline constexpr int max_threads = 1024;

/// A picture to be rendered, or a series of them. What is not chosen comes from the scene.
struct RenderJob : SceneJob {
  std::optional<FrameRange> frames{};
  /// Pictures from frame to frame of a series, whose frames are then numbers of pictures: picture n
  /// is at frame n / interpolate.
  int interpolate = 1;
  std::optional<int> turn{};  ///< the frames are so many pictures of one scene that turns once
  std::string camera{};       ///< keys of [camera]; empty: the scene's
  std::optional<Size> size{};
  std::optional<double> width{};  ///< in print, mm
  std::optional<double> dpi{};
  std::optional<int> spp{};
  std::optional<float> noise{};  ///< 0..1; 0: all pixels get the same samples
  std::optional<int> min_spp{};
  std::optional<float> aa{};  ///< codes, 0..255; 0: all pixels get the same samples
  std::optional<PixelFilter> filter{};
  std::optional<BackgroundChoice> background{};
  std::optional<OutlineWidth> outline{};
  std::optional<float> fog{};             ///< 0..1
  std::optional<OverlayParts> overlay{};  ///< drawn on the finished picture
  std::uint64_t seed = 0;
  std::optional<PixelRect> crop{};
  AovSelection aovs{};
  std::optional<Method> method{};
  std::optional<int> max_depth{};
  std::optional<float> least_weight{};    ///< as RenderOptions
  std::optional<float> shadow_epsilon{};  ///< as RenderOptions
  float exposure_stops = 0;
  std::optional<PixelOrder> order{};   ///< none: tiles, or progressive for a partial picture
  int tile = 0;                        ///< 0: chosen to fit
  std::optional<double> time_limit{};  ///< seconds of rendering
  bool partial = false;                ///< if ended early, there is an unfinished picture
};

/// The size that the job asks for.
SizeChoice size_choice(const RenderJob& job);

/// The options of the rendering that the job asks for, of this scene.
RenderOptions options_of(const RenderJob& job, const Scene& scene);

/// What is to be drawn on the picture of this scene.
OverlayParts overlay_of(const RenderJob& job, const Scene& scene);

/// Puts the choice of a background, if there is one, into the scene.
void choose_background(const std::optional<BackgroundChoice>& choice, Scene& scene);

}  // namespace boule
