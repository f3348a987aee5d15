/// Writes an ST map for [camera.distortion]: a picture whose red and green say where on the film a
/// point of the picture is seen, with the radial distortion of a simple lens.
///
///   boule_st_map AMOUNT WIDTH HEIGHT FILE.exr
///
/// AMOUNT k: above 0, to 4, a barrel; below 0, to -0.3, a pincushion. What is seen at the distance
/// r from the middle, 1 in the corners, lies at r (1 + k r^2) / (1 + k): the corners stay where
/// they are. WIDTH and HEIGHT, 2 to 4096: pixels of the map; their ratio should be the picture's,
/// their number need not. Only + - * /: the numbers are the same on every machine.
#include <charconv>
#include <cstdio>
#include <string_view>

#include "render/image/write_image.h"

namespace {

using namespace boule;

/// The whole of a text as a number from `low` to `high`.
template <class Number>
bool parse(std::string_view text, Number low, Number high, Number& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size() && out >= low && out <= high;
}

Image st_map(double amount, int width, int height) {
  Image map(width, height);
  const double diagonal2 = 1.0 * width * width + 1.0 * height * height;
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const double x = 2 * (i + 0.5) - width, y = height - 2 * (j + 0.5);
      const double scale = (1 + amount * ((x * x + y * y) / diagonal2)) / (1 + amount);
      map.at(i, j) = {static_cast<float>(0.5 + x * scale / (2.0 * width)),
                      static_cast<float>(0.5 + y * scale / (2.0 * height)), 0};
    }
  }
  return map;
}

}  // namespace

int main(int argc, char** argv) {
  double amount = 0;
  int width = 0, height = 0;
  if (argc != 5 || !parse(argv[1], -0.3, 4.0, amount) || !parse(argv[2], 2, 4096, width) ||
      !parse(argv[3], 2, 4096, height)) {
    std::fputs("usage: boule_st_map AMOUNT WIDTH HEIGHT FILE.exr    (AMOUNT -0.3 to 4)\n", stderr);
    return 2;
  }
  if (const Status done = write_image(st_map(amount, width, height), argv[4]); !done) {
    std::fprintf(stderr, "%s\n", format_diagnostic(done.error()).c_str());
    return 1;
  }
  return 0;
}
