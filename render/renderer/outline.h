#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"
#include "render/frame/pixel_rect.h"
#include "render/image/image.h"
#include "render/integrators/scene_search.h"
#include "render/prepare/fog.h"
#include "render/renderer/block_worker.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Dark lines where the camera's view changes from one primitive to another, or to a miss, but for
/// primitives of one group (OutlineGroups) that are near each other (outline_jump). The view is
/// sampled by rays through a grid of points, outline_grid x outline_grid in each pixel.
inline constexpr int outline_grid = 4;

/// The ink of a point that lies on a line; in fog it is less.
inline constexpr int ink_of_point = 15;

/// The lines of a picture: the ink of each pixel's points together. Two threads may set different
/// pixels in parallel.
class Outline {
 public:
  /// Without lines, for the frame's pixels in `rect`.
  explicit Outline(const PixelRect& rect)
      : rect_(rect), ink_(static_cast<std::size_t>(rect.area())) {}

  /// The ink of a pixel all of whose points lie on lines.
  static constexpr int most_ink = outline_grid * outline_grid * ink_of_point;

  /// Preconditions: pixel (x, y) of the frame lies in `rect`; `ink` is at most most_ink.
  void set(int x, int y, int ink) { ink_[rect_.index(x, y)] = static_cast<std::uint8_t>(ink); }

  /// The ink of pixel (x, y) of the frame. Precondition: it lies in `rect`.
  [[nodiscard]] int ink(int x, int y) const { return ink_[rect_.index(x, y)]; }

  /// Draws the lines in black. Alpha becomes that of the picture with the lines over it.
  /// Precondition: the picture has the same pixels.
  void draw(Image& image) const;

  /// The number of bytes of the lines of the pixels in `rect`.
  static std::uint64_t bytes(const PixelRect& rect) { return rect.area(); }

 private:
  PixelRect rect_;
  std::vector<std::uint8_t> ink_;
};

/// The largest width of a line as a fraction of the nearer sphere's radius in the picture, so that
/// a crowd of specks stays visible.
inline constexpr double outline_share = 0.1;

/// The same around primitives of a group, most of whose lines go around many of them.
inline constexpr double outline_group_share = 0.5;

/// Two primitives of one group have a line between them where one lies behind the other by more
/// than so many radii of the nearer one. Chosen by eye.
inline constexpr double outline_jump = 3;

/// Finds the lines of blocks on one thread. A pixel's lines depend only on the scene, the camera
/// and the size of the frame, and on points within the frame. Rays go through the centre of a lens.
class OutlineWorker {
 public:
  /// The lines to draw. A line is `width` pixels wide, 0..100, half of it on either side of the
  /// change; it is drawn in steps of half a pixel. Around a small sphere it is narrower
  /// (outline_share). In fog, a pixel's lines are as faint as the nearest thing that they go
  /// around.
  struct Lines {
    PixelRect frame;
    float width;
    Solver solver;
    Fog fog{};
  };

  /// The side of the blocks for which it is fastest, in pixels.
  static constexpr int block_side = 64;

  /// `setup` must outlive it.
  OutlineWorker(const BlockSetup& setup, const Lines& lines);

  /// Sets every pixel of a block.
  void find(const PixelRect& block, Outline& outline);

  /// All rays that this worker traced.
  [[nodiscard]] RayCounts counts() const { return {.primary = primary_}; }

 private:
  void find_hits();
  void trace(int x0, int y0);
  [[nodiscard]] bool is_bare(int x0, int y0) const;
  void mark_changes();
  void mark_beside(int x, int y, const std::vector<int>& half_widths);
  void mark_below(int x, int y, const std::vector<int>& half_widths);
  void mark(int y, int first, int last);
  void see_through_fog(std::size_t a, std::size_t b);
  void count_points(const PixelRect& block, Outline& outline) const;
  [[nodiscard]] bool differ(const Hit& a, const Hit& b) const;
  [[nodiscard]] double radius_of(const Hit& hit) const;
  [[nodiscard]] const std::vector<int>& disc_between(const Hit& a, const Hit& b) const;
  /// Whether a line goes between two points; around a cap it always does.
  [[nodiscard]] bool changes(std::size_t a, std::size_t b) const {
    const auto is_cap = [this](std::size_t at) { return surfaces_[at] != seen_[at].id; };
    const bool at_cap =
        !surfaces_.empty() && surfaces_[a] != surfaces_[b] && (is_cap(a) || is_cap(b));
    return at_cap || differ(seen_[a], seen_[b]);
  }
  [[nodiscard]] const Hit& hit(int x, int y) const { return seen_[points_.index(x, y)]; }

  const BlockSetup& setup_;
  Solver solver_;
  PixelRect frame_;  ///< here and below: in points of the grid
  float width_;      ///< in pixels
  /// For lines of 0, 1, 2, ... half pixels, and at the end for those of the full width: their reach
  /// to either side of a change, by the distance from it, both in halves of the grid's spacing.
  std::vector<std::vector<int>> discs_;
  Vec3d step_org_, step_dir_;  ///< from one pixel to the next, in the middle of the frame
  std::vector<PixelOffset> order_;
  PixelRect marked_;       ///< the points of the block
  PixelRect points_;       ///< those and the relevant ones around them
  std::vector<Hit> seen_;  ///< by `points_`; t in units of length
  std::vector<std::int32_t>
      surfaces_;  ///< likewise: ids of SceneSearch::surfaces(), where any is cut
  Fog fog_;
  std::vector<float> veils_;  ///< likewise: shares of fog, if there is any
  float seen_now_ = 1;        ///< of the line that is marked: less the share of fog before it
  std::vector<float> clear_;  ///< by pixel of the block: the largest of these, if there is fog
  std::vector<int> steps_;    ///< of `marked_`: number of lines that begin less number that end
  SceneSearch search_;
  SampleBuffer samples_;
  RayBuffer rays_;
  HitBuffer hits_, caps_;
  std::uint64_t primary_ = 0;
};

}  // namespace boule
