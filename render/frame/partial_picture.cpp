#include "render/frame/partial_picture.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/float_environment.h"
#include "render/frame/live_passes.h"

namespace boule {
namespace {

/// A pixel, counted from the film's upper left one.
struct Pixel {
  int x, y;
};
constexpr Pixel no_pixel{-1, -1};

bool has_samples(const Film& film, int x, int y) {
  return film.samples(film.rect().x0 + x, film.rect().y0 + y) > 0;
}

/// The coarse pixel with samples whose block holds (x, y), of several the one with the smallest
/// block; no_pixel if none has samples.
Pixel coarse_pixel(const Film& film, int x, int y) {
  for (int spacing = 2; spacing <= coarsest_spacing; spacing *= 2) {
    const Pixel coarse{x & -spacing, y & -spacing};
    if (has_samples(film, coarse.x, coarse.y)) return coarse;
  }
  return no_pixel;
}

/// Finds, for each pixel of a film, the nearest one with samples: first within its column, then
/// within its row, where the nearest columns are the lower envelope of parabolas (Felzenszwalb and
/// Huttenlocher, "Distance transforms of sampled functions", 2012). All in integers.
class NearestPixels {
 public:
  explicit NearestPixels(const Film& film)
      : width_(film.rect().width()),
        height_(film.rect().height()),
        nearest_y_(static_cast<std::size_t>(film.rect().area()), -1) {
    for (int x = 0; x < width_; ++x) fill_column(film, x);
  }

  /// The nearest pixels of row y, by x; no_pixel if no pixel of the film has samples.
  void find_row(int y, std::vector<Pixel>& nearest);

 private:
  /// A piece of the envelope: the parabola around column x is the lowest from column `from` on.
  struct Piece {
    int x;
    std::int64_t from;
  };

  int& nearest_y(int x, int y) {
    return nearest_y_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x)];
  }
  void fill_column(const Film& film, int x);
  void find_envelope(int y);
  std::int64_t column_distance(int x, int y) {
    const std::int64_t dy = nearest_y(x, y) - y;
    return dy * dy;
  }

  int width_, height_;
  /// By pixel: the row of the nearest pixel with samples in the same column, or -1.
  std::vector<int> nearest_y_;
  std::vector<Piece> envelope_;
};

void NearestPixels::fill_column(const Film& film, int x) {
  int above = -1;
  for (int y = 0; y < height_; ++y) {
    if (has_samples(film, x, y)) above = y;
    nearest_y(x, y) = above;
  }
  int below = -1;
  for (int y = height_ - 1; y >= 0; --y) {
    int& nearest = nearest_y(x, y);
    if (nearest == y) below = y;
    if (below >= 0 && (nearest < 0 || below - y < y - nearest)) nearest = below;
  }
}

void NearestPixels::find_row(int y, std::vector<Pixel>& nearest) {
  find_envelope(y);
  nearest.assign(static_cast<std::size_t>(width_), no_pixel);
  std::size_t piece = 0;
  for (int x = 0; x < width_ && !envelope_.empty(); ++x) {
    while (piece + 1 < envelope_.size() && envelope_[piece + 1].from <= x) ++piece;
    const int column = envelope_[piece].x;
    nearest[static_cast<std::size_t>(x)] = {column, nearest_y(column, y)};
  }
}

void NearestPixels::find_envelope(int y) {
  envelope_.clear();
  for (int x = 0; x < width_; ++x) {
    if (nearest_y(x, y) < 0) continue;
    // Of two columns q < x with distances e and d, the parabola (p - x)^2 + d is the lower one
    // where p > ((x^2 + d) - (q^2 + e)) / 2 (x - q).
    const std::int64_t height = std::int64_t{x} * x + column_distance(x, y);
    std::int64_t from = 0;
    while (!envelope_.empty()) {
      const auto [q, begin] = envelope_.back();
      const std::int64_t over = height - std::int64_t{q} * q - column_distance(q, y);
      const std::int64_t step = 2 * (std::int64_t{x} - q);
      from = over < 0 ? 0 : over / step + 1;
      if (from > begin) break;
      envelope_.pop_back();
      from = 0;
    }
    if (from < width_) envelope_.push_back({x, from});
  }
}

bool needs_nearest(const Film& film, PixelOrder order) {
  const int width = film.rect().width(), height = film.rect().height();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (has_samples(film, x, y)) continue;
      if (order == PixelOrder::frameless || coarse_pixel(film, x, y).x < 0) return true;
    }
  }
  return false;
}

void fill_coarse(const Film& film, Image& image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (has_samples(film, x, y)) continue;
      const Pixel coarse = coarse_pixel(film, x, y);
      if (coarse.x >= 0) image.copy_pixel(coarse.x, coarse.y, x, y);
    }
  }
}

void fill_nearest(const Film& film, PixelOrder order, Image& image) {
  NearestPixels pixels(film);
  std::vector<Pixel> nearest;
  for (int y = 0; y < image.height; ++y) {
    pixels.find_row(y, nearest);
    for (int x = 0; x < image.width; ++x) {
      if (has_samples(film, x, y)) continue;
      if (order == PixelOrder::progressive && coarse_pixel(film, x, y).x >= 0) continue;
      const Pixel from = nearest[static_cast<std::size_t>(x)];
      if (from.x >= 0) image.copy_pixel(from.x, from.y, x, y);
    }
  }
}

}  // namespace

Image partial_picture(const Film& film, PixelOrder order, Alpha alpha) {
  const FloatEnvironment environment;
  Image image = film.to_image(alpha);
  if (order == PixelOrder::rows || order == PixelOrder::tiles) return image;
  if (order == PixelOrder::progressive) fill_coarse(film, image);
  if (needs_nearest(film, order)) fill_nearest(film, order, image);
  return image;
}

Image partial_picture(const Film& film, const MeasuredPicture& measured, PixelOrder order,
                      Alpha alpha) {
  Image image = partial_picture(film, order, alpha);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const MeasuredPixel& pixel = measured.pixels()[i];
    if (pixel.samples > 0) image.set(i, pixel.color, pixel.alpha);
  }
  return image;
}

}  // namespace boule
