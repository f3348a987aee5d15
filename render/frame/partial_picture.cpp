#include "render/frame/partial_picture.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/float_environment.h"
#include "render/frame/live_passes.h"

namespace boule {
namespace {

/// Places count from the film's upper left pixel.
struct Place {
  int x, y;
};

bool has_samples(const Film& film, int x, int y) {
  return film.samples(film.rect().x0 + x, film.rect().y0 + y) > 0;
}

/// The finest coarse pixel that stands for (x, y); (-1, -1) where none has samples.
Place coarse_pixel(const Film& film, int x, int y) {
  for (int spacing = 2; spacing <= coarsest_spacing; spacing *= 2) {
    const Place coarse{x & -spacing, y & -spacing};
    if (has_samples(film, coarse.x, coarse.y)) return coarse;
  }
  return {-1, -1};
}

/// For each pixel of a film the nearest one with samples: along the columns first, then along the
/// rows as the lower envelope of parabolas (Felzenszwalb and Huttenlocher, "Distance transforms of
/// sampled functions", 2012), in integers.
class NearestPixels {
 public:
  explicit NearestPixels(const Film& film)
      : width_(film.rect().width()),
        height_(film.rect().height()),
        nearest_y_(static_cast<std::size_t>(film.rect().area()), -1) {
    for (int x = 0; x < width_; ++x) fill_column(film, x);
  }

  /// The nearest pixels of row y, by x; (-1, -1) where the whole film has none.
  void find_row(int y, std::vector<Place>& nearest);

 private:
  /// The parabola over column x, best from column `from` on.
  struct Piece {
    int x;
    std::int64_t from;
  };

  int& nearest_y(int x, int y) {
    return nearest_y_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x)];
  }
  void fill_column(const Film& film, int x);
  std::int64_t column_distance(int x, int y) {
    const std::int64_t dy = nearest_y(x, y) - y;
    return dy * dy;
  }

  int width_, height_;
  std::vector<int> nearest_y_;  ///< by pixel: the nearest row with samples in its column, or -1
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

void NearestPixels::find_row(int y, std::vector<Place>& nearest) {
  envelope_.clear();
  for (int x = 0; x < width_; ++x) {
    if (nearest_y(x, y) < 0) continue;
    // (p - x)^2 + d is below (p - q)^2 + e, q < x, for p > ((x^2 + d) - (q^2 + e)) / 2 (x - q).
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
  nearest.assign(static_cast<std::size_t>(width_), {-1, -1});
  std::size_t piece = 0;
  for (int x = 0; x < width_ && !envelope_.empty(); ++x) {
    while (piece + 1 < envelope_.size() && envelope_[piece + 1].from <= x) ++piece;
    const int column = envelope_[piece].x;
    nearest[static_cast<std::size_t>(x)] = {column, nearest_y(column, y)};
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
      const Place coarse = coarse_pixel(film, x, y);
      if (coarse.x >= 0) image.at(x, y) = image.at(coarse.x, coarse.y);
    }
  }
}

void fill_nearest(const Film& film, PixelOrder order, Image& image) {
  NearestPixels pixels(film);
  std::vector<Place> nearest;
  for (int y = 0; y < image.height; ++y) {
    pixels.find_row(y, nearest);
    for (int x = 0; x < image.width; ++x) {
      if (has_samples(film, x, y)) continue;
      if (order == PixelOrder::progressive && coarse_pixel(film, x, y).x >= 0) continue;
      const Place place = nearest[static_cast<std::size_t>(x)];
      if (place.x >= 0) image.at(x, y) = image.at(place.x, place.y);
    }
  }
}

}  // namespace

Image partial_picture(const Film& film, PixelOrder order) {
  const FloatEnvironment environment;
  Image image = film.to_image();
  if (order == PixelOrder::rows || order == PixelOrder::tiles) return image;
  if (order == PixelOrder::progressive) fill_coarse(film, image);
  if (needs_nearest(film, order)) fill_nearest(film, order, image);
  return image;
}

}  // namespace boule
