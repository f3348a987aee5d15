#include "render/frame/film.h"

#include <algorithm>
#include <limits>

#include "core/base/float_environment.h"

namespace boule {
namespace {

/// The mean of a pixel's samples, of which there are some.
Color mean(const FilmPixel& pixel) {
  const auto of = [&](double sum) {
    constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
    return static_cast<float>(std::min(pixel.samples == 1 ? sum : sum / pixel.samples, largest));
  };
  return {of(pixel.r), of(pixel.g), of(pixel.b)};
}

float coverage(const FilmPixel& pixel) {
  return static_cast<float>(pixel.covered / (double{whole_coverage} * pixel.samples));
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
    for (std::size_t i = row; i < row + static_cast<std::size_t>(rect_.width()); ++i, ++pixel) {
      const bool has_samples = pixel->samples > 0;
      image.pixels[i] = has_samples ? mean(*pixel) : Color{};
      if (!image.alpha.empty()) image.alpha[i] = has_samples ? coverage(*pixel) : 0;
    }
  }
}

}  // namespace boule
