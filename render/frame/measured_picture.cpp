#include "render/frame/measured_picture.h"

#include <algorithm>

namespace boule {

Image MeasuredPicture::image(Alpha alpha) const {
  Image image(rect_.width(), rect_.height(), alpha);
  copy_to(image, rect_);
  return image;
}

void MeasuredPicture::copy_to(Image& image, const PixelRect& rect) const {
  const MeasuredPixel* pixel = pixels_.data();
  for (int y = rect_.y0; y < rect_.y1; ++y) {
    std::size_t at = image.index(rect_.x0 - rect.x0, y - rect.y0);
    for (int x = rect_.x0; x < rect_.x1; ++x, ++pixel) image.set(at++, pixel->color, pixel->alpha);
  }
}

std::vector<float> MeasuredPicture::noise() const {
  std::vector<float> noise;
  noise.reserve(pixels_.size());
  for (const MeasuredPixel& pixel : pixels_) noise.push_back(pixel.noise);
  return noise;
}

std::vector<std::uint32_t> MeasuredPicture::samples() const {
  std::vector<std::uint32_t> samples;
  samples.reserve(pixels_.size());
  for (const MeasuredPixel& pixel : pixels_) samples.push_back(pixel.samples);
  return samples;
}

std::uint64_t count_measured(const MeasuredPicture& picture) {
  const auto has_samples = [](const MeasuredPixel& pixel) { return pixel.samples > 0; };
  return static_cast<std::uint64_t>(
      std::count_if(picture.pixels().begin(), picture.pixels().end(), has_samples));
}

NoiseSoFar noise_so_far(const MeasuredPicture& picture, const PixelRect& block, int max_spp) {
  NoiseSoFar noise;
  for (int y = block.y0; y < block.y1; ++y) {
    for (const MeasuredPixel& pixel : picture.row(block.x0, block.x1, y)) {
      if (pixel.samples > 0) noise.add(pixel.samples, most_samples(max_spp));
    }
  }
  return noise;
}

NoiseReached noise_reached(const MeasuredPicture& picture, int max_spp) {
  std::vector<float> noise;
  for (const MeasuredPixel& pixel : picture.pixels()) {
    if (pixel.samples > 0) noise.push_back(pixel.noise);
  }
  if (noise.empty()) return {};
  const std::size_t place = (noise.size() - 1) * 95 / 100;
  std::nth_element(noise.begin(), noise.begin() + static_cast<std::ptrdiff_t>(place), noise.end());
  const NoiseSoFar all = noise_so_far(picture, picture.rect(), max_spp);
  return {static_cast<double>(noise[place]) * interval_in_errors, all.mean_samples(),
          all.settled_share()};
}

}  // namespace boule
