#include "bench/peers/frames/frame_pictures.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

namespace boule::bench {
namespace {

Diagnostic unreadable(const std::string& path, const std::string& reason) {
  return Diagnostic::of("cannot read the picture " + quote(path, 200) + ": " + reason);
}

float linear(float code) {
  return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
}

float at_most_one(float x) { return std::min(x, 1.0F); }

struct Deviation {
  float sum, largest;
};

Deviation deviation(const Color& ours, const Color& theirs, const Color& habit) {
  const float d[] = {std::fabs(theirs.r - at_most_one(ours.r + habit.r)),
                     std::fabs(theirs.g - at_most_one(ours.g + habit.g)),
                     std::fabs(theirs.b - at_most_one(ours.b + habit.b))};
  return {d[0] + d[1] + d[2], *std::max_element(d, d + 3)};
}

}  // namespace

Result<Image> read_picture(const std::string& path, Curve curve) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) return unreadable(path, OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.nchannels != 3) return unreadable(path, "it has not three channels");
  Image image(spec.width, spec.height);
  static_assert(sizeof(Color) == 3 * sizeof(float));
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeFloat, image.pixels.data())) {
    return unreadable(path, input->geterror());
  }
  if (curve == Curve::linear) return image;
  for (Color& c : image.pixels) c = {linear(c.r), linear(c.g), linear(c.b)};
  return image;
}

Difference compare_pictures(const Image& ours, const Image& theirs, const Color& habit) {
  constexpr float visible = 0.1F;
  if (ours.width != theirs.width || ours.height != theirs.height) return {1, 1};
  double sum = 0;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
    const Deviation plain = deviation(ours.pixels[i], theirs.pixels[i], {});
    const Deviation excused = deviation(ours.pixels[i], theirs.pixels[i], habit);
    const Deviation& nearer = excused.largest < plain.largest ? excused : plain;
    sum += static_cast<double>(nearer.sum);
    if (nearer.largest > visible) ++differing;
  }
  const auto pixels = static_cast<double>(ours.pixels.size());
  return {sum / (3 * pixels), static_cast<double>(differing) / pixels};
}

}  // namespace boule::bench
