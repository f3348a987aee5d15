#include "render/frame/film.h"

#include <algorithm>
#include <limits>

#include "core/base/float_environment.h"

namespace boule {
namespace {

float mean(double sum, std::int32_t samples) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::min(sum / samples, largest));
}

}  // namespace

std::uint64_t Film::total_samples() const {
  std::uint64_t total = 0;
  for (const FilmPixel& pixel : pixels_) total += static_cast<std::uint64_t>(pixel.samples);
  return total;
}

Image Film::to_image(Alpha alpha) const {
  const FloatEnvironment environment;
  Image image(rect_.width(), rect_.height(), alpha);
  copy_to(image, rect_);
  return image;
}

void Film::copy_to(Image& image, const PixelRect& rect) const {
  const FilmPixel* pixel = pixels_.data();
  for (int y = rect_.y0; y < rect_.y1; ++y) {
    const std::size_t row = image.index(rect_.x0 - rect.x0, y - rect.y0);
    for (std::size_t x = 0; x < static_cast<std::size_t>(rect_.width()); ++x, ++pixel) {
      const auto& [r, g, b, samples, covered] = *pixel;
      if (samples == 0) {
        image.set(row + x, {}, 0);
      } else {
        image.set(row + x, {mean(r, samples), mean(g, samples), mean(b, samples)},
                  static_cast<float>(static_cast<double>(covered) / samples));
      }
    }
  }
}

}  // namespace boule
