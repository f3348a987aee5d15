#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"
#include "render/frame/pixel_rect.h"
#include "render/image/image.h"
#include "render/renderer/block_worker.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Dark lines where what the camera sees changes from one primitive to another, or to nothing. What
/// it sees is told by the rays through a grid of points, outline_grid x outline_grid in each pixel.
inline constexpr int outline_grid = 4;

/// The lines of a picture: how many points of each pixel lie on one. Two threads may set different
/// pixels at the same time.
class Outline {
 public:
  /// No lines yet, for the frame's pixels in `rect`.
  explicit Outline(const PixelRect& rect)
      : rect_(rect), points_(static_cast<std::size_t>(rect.area())) {}

  /// Preconditions: pixel (x, y) of the frame lies in `rect`; it has no more points than that.
  void set(int x, int y, int points) {
    points_[rect_.index(x, y)] = static_cast<std::uint8_t>(points);
  }

  /// How many points of pixel (x, y) of the frame lie on a line. Precondition: it lies in `rect`.
  [[nodiscard]] int points(int x, int y) const { return points_[rect_.index(x, y)]; }

  /// Draws the lines in black. Alpha becomes that of the picture and the lines over it.
  /// Precondition: the picture is of the same pixels.
  void draw(Image& image) const;

  /// Bytes that the lines of the pixels in `rect` take.
  static std::uint64_t bytes(const PixelRect& rect) { return rect.area(); }

 private:
  PixelRect rect_;
  std::vector<std::uint8_t> points_;
};

/// What a line is at most wide, as a share of the radius that the nearer sphere has in the picture:
/// a crowd of specks must not become black.
inline constexpr double outline_share = 0.1;

/// Finds the lines of blocks on one thread. A pixel's lines depend on the scene, the camera and the
/// size of the frame only; nothing beyond the frame is looked at. Rays go through the centre of a
/// lens.
class OutlineWorker {
 public:
  /// What is drawn. A line is `width` pixels wide, 0..100, half of it on either side of the change;
  /// it is drawn in steps of half a pixel. Around a small sphere it is narrower (outline_share).
  struct Lines {
    PixelRect frame;
    float width;
    Solver solver;
  };

  /// The side of the blocks that it is best at, in pixels.
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
  void mark_changes();
  void mark_beside(int x, int y, const std::vector<int>& half_widths);
  void mark_below(int x, int y, const std::vector<int>& half_widths);
  void mark(int y, int first, int last);
  void count_points(const PixelRect& block, Outline& outline) const;
  [[nodiscard]] const std::vector<int>& disc_between(const Hit& a, const Hit& b) const;
  [[nodiscard]] const Hit& hit(int x, int y) const { return seen_[points_.index(x, y)]; }

  const BlockSetup& setup_;
  Solver solver_;
  PixelRect frame_;  ///< here and below: in points of the grid
  float width_;      ///< in pixels
  /// Lines of 0, 1, 2, ... half pixels, and at the end those of the full width: how far they reach
  /// to either side of a change, by the distance from it, both in halves of the grid's spacing.
  std::vector<std::vector<int>> discs_;
  Vec3d step_org_, step_dir_;  ///< from one pixel to the next, in the middle of the frame
  std::vector<PixelOffset> order_;
  PixelRect marked_;        ///< the points of the block
  PixelRect points_;        ///< those and the ones around them that can matter
  std::vector<Hit> seen_;   ///< by `points_`; t in units of length
  std::vector<int> steps_;  ///< of `marked_`: lines that begin less lines that have ended
  SampleBuffer samples_;
  RayBuffer rays_;
  HitBuffer hits_;
  std::uint64_t primary_ = 0;
};

}  // namespace boule
