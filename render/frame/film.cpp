#include "render/frame/film.h"

#include <algorithm>
#include <limits>

namespace boule {
namespace {

float mean(double sum, std::int32_t samples) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::min(sum / samples, largest));
}

}  // namespace

Image Film::to_image() const {
  Image image(rect_.width(), rect_.height());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Pixel& p = pixels_[i];
    if (p.samples == 0) continue;
    image.pixels[i] = {mean(p.r, p.samples), mean(p.g, p.samples), mean(p.b, p.samples)};
  }
  return image;
}

}  // namespace boule
