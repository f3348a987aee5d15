#include "render/frame/film.h"

#include <gtest/gtest.h>

#include <limits>

namespace boule {
namespace {

TEST(Film, HoldsSampleMeansInFrameCoordinates) {
  Film film({10, 20, 13, 22});
  film.add(12, 21, {1, 2, 3});
  film.add(12, 21, {0, 1, 5});
  const Image image = film.to_image();
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.at(2, 1), (Color{0.5f, 1.5f, 4}));
  EXPECT_EQ(image.at(0, 0), Color{});
  EXPECT_EQ(film.samples(12, 21), 2);
  EXPECT_EQ(film.samples(10, 20), 0);
}

TEST(Film, CopiesPixelsToTheirPlace) {
  Film film({0, 0, 9, 9});
  film.add(3, 3, gray(7));
  film.restart({11, 21, 13, 22});
  EXPECT_EQ(film.samples(11, 21), 0);
  film.add(12, 21, gray(3));
  film.add(12, 21, gray(4));
  Image image(4, 2);
  for (Color& pixel : image.pixels) pixel = gray(1);
  film.copy_to(image, {10, 20, 14, 22});
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      const float expected = y == 1 && x == 1 ? 0.0f : y == 1 && x == 2 ? 3.5f : 1.0f;
      EXPECT_EQ(image.at(x, y), gray(expected)) << x << ' ' << y;
    }
  }
}

TEST(Film, SumsOfTheLargestFloatsStayFinite) {
  constexpr float largest = std::numeric_limits<float>::max();
  Film film({0, 0, 1, 1});
  for (int i = 0; i < 7; ++i) film.add(0, 0, gray(largest));
  EXPECT_EQ(film.to_image().at(0, 0), gray(largest));
}

TEST(Film, SmallSamplesSurviveALargeOne) {
  Film film({0, 0, 1, 1});
  film.add(0, 0, gray(16777216));
  for (int i = 0; i < 7; ++i) film.add(0, 0, gray(1));  // a float sum would not change
  EXPECT_EQ(film.to_image().at(0, 0).r, 16777223.0f / 8);
}

}  // namespace
}  // namespace boule
