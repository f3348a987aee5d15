// Pictures that are shown as they grow: each step shows a whole picture, and the last one the
// finished picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "render/frame/live_passes.h"
#include "render/frame/partial_picture.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

constexpr PixelOrder all_orders[] = {PixelOrder::rows, PixelOrder::tiles, PixelOrder::progressive,
                                     PixelOrder::frameless};

TEST(LivePasses, GiveEveryPixelItsSamples) {
  const PixelRect rects[] = {{0, 0, 1, 1}, {0, 0, 37, 23}, {5, 7, 38, 60}, {0, 0, 64, 64}};
  for (const PixelRect& rect : rects) {
    for (const PixelOrder order : all_orders) {
      const LivePasses passes(order, rect, 3);
      Film film(rect);
      double share = 0;
      for (std::size_t i = 0; i < passes.size(); ++i) {
        const LivePass pass = passes[i];
        EXPECT_GT(pass.share, share);
        share = pass.share;
        for (int y = rect.y0; y < rect.y1; ++y) {
          for (int x = rect.x0; x < rect.x1; ++x) {
            while (pass.pick.takes(x, y) && film.samples(x, y) < pass.until) film.add(x, y, {});
          }
        }
      }
      EXPECT_EQ(share, 1);
      EXPECT_EQ(film.total_samples(), rect.area() * 3);
      EXPECT_EQ(film.samples(rect.x1 - 1, rect.y1 - 1), 3);
    }
  }
}

TEST(LivePasses, ProgressiveHalvesItsSpacing) {
  const LivePasses passes(PixelOrder::progressive, {3, 5, 103, 105}, 4);
  ASSERT_EQ(passes.size(), 8u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(passes[i].pick.spacing, 16 >> i);
    EXPECT_TRUE(passes[i].pick.takes(3 + 16, 5 + 32));
    EXPECT_EQ(passes[i].pick.takes(4, 5), i == 4);
  }
}

TEST(LivePasses, FramelessTakesEvenlySpreadSixteenths) {
  const PixelRect rect{0, 0, 256, 256};
  const LivePasses passes(PixelOrder::frameless, rect, 1);
  ASSERT_EQ(passes.size(), 16u);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    int quarters[4] = {};
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        if (passes[i].pick.takes(x, y)) ++quarters[(y / 128) * 2 + x / 128];
      }
    }
    for (const int count : quarters) EXPECT_NEAR(count, 1024, 160);  // five standard deviations
  }
}

/// What partial_picture() promises, found by searching all pixels for each pixel.
Color expected_pixel(const Film& film, const Image& done, PixelOrder order, int x, int y) {
  const PixelRect& rect = film.rect();
  const auto known = [&](int px, int py) { return film.samples(rect.x0 + px, rect.y0 + py) > 0; };
  if (known(x, y)) return done.at(x, y);
  if (order == PixelOrder::rows || order == PixelOrder::tiles) return {};
  for (int s = 2; s <= 16 && order == PixelOrder::progressive; s *= 2) {
    if (known(x / s * s, y / s * s)) return done.at(x / s * s, y / s * s);
  }
  Color nearest;
  int least = std::numeric_limits<int>::max();
  for (int px = 0; px < done.width; ++px) {
    for (int py = 0; py < done.height; ++py) {
      const int distance = (px - x) * (px - x) + (py - y) * (py - y);
      if (!known(px, py) || distance >= least) continue;
      least = distance;
      nearest = done.at(px, py);
    }
  }
  return nearest;
}

TEST(PartialPicture, FillsMissingPixelsAsDocumented) {
  const PixelRect rects[] = {{0, 0, 40, 33}, {3, 9, 50, 31}, {0, 0, 1, 30}, {0, 0, 30, 1}};
  CaseRandom random(3);
  for (const PixelRect& rect : rects) {
    for (const double density : {0.0, 0.003, 0.02, 0.1, 0.5, 1.0}) {
      Film film(rect);
      for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) {
          if (random.uniform(0, 1) >= density) continue;
          film.add(x, y, {static_cast<float>(x + 1), static_cast<float>(y + 1), 1});
        }
      }
      const Image done = film.to_image();
      for (const PixelOrder order : all_orders) {
        const Image picture = partial_picture(film, order);
        int wrong = 0;
        for (int y = 0; y < picture.height; ++y) {
          for (int x = 0; x < picture.width; ++x) {
            const bool same = same_bits(picture.at(x, y), expected_pixel(film, done, order, x, y));
            wrong += same ? 0 : 1;
          }
        }
        EXPECT_EQ(wrong, 0) << rect.x1 << "x" << rect.y1 << " " << density << " order "
                            << static_cast<int>(order);
      }
    }
  }
}

class Live : public testing::Test {
 protected:
  Live() : scene_(mixed_scene(70, 45)) {
    scene_.image.spp = 3;
    finished_ = render(scene_);
    for (int until = 1; until <= 3; ++until) {
      auto renderer = Renderer::create(scene_, options_of(scene_));
      Film film(renderer.value().rect());
      EXPECT_TRUE(renderer.value().render_pass(film, until));
      by_samples_.push_back(film.to_image());
    }
  }

  /// The number of pixels with samples whose colour is not that of the pixel with as many samples.
  int wrong_pixels(const Film& film) const {
    const Image image = film.to_image();
    int wrong = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const int frame_x = film.rect().x0 + x, frame_y = film.rect().y0 + y;
        const int samples = film.samples(frame_x, frame_y);
        if (samples == 0) continue;
        const Image& expected = by_samples_[static_cast<std::size_t>(samples - 1)];
        wrong += same_bits(image.at(x, y), expected.at(frame_x, frame_y)) ? 0 : 1;
      }
    }
    return wrong;
  }

  Scene scene_;
  Image finished_;
  std::vector<Image> by_samples_;  ///< with 1, 2, 3 samples
};

TEST_F(Live, LastStepEqualsThePicture) {
  for (const PixelOrder order : all_orders) {
    for (const unsigned threads : {1u, 3u}) {
      for (const int tile : {0, 7, 16, 64}) {
        RenderOptions options = options_of(scene_);
        options.order = order;
        options.threads = threads;
        options.tile = tile;
        std::size_t updates = 0;
        std::uint64_t samples = 0;
        options.update = [&](const Film& film) {
          ++updates;
          EXPECT_EQ(wrong_pixels(film), 0);
          EXPECT_GT(film.total_samples(), samples);
          samples = film.total_samples();
        };
        double share = 0;
        options.progress = [&](const Progress& p) { share = p.share; };
        auto renderer = Renderer::create(scene_, options);
        Film film(renderer.value().rect());
        EXPECT_TRUE(renderer.value().render_live(film));
        EXPECT_EQ(updates, LivePasses(order, film.rect(), 3).size());
        EXPECT_EQ(share, 1);
        EXPECT_EQ(differing_pixels(film.to_image(), finished_), 0);
      }
    }
  }
}

TEST_F(Live, EveryIsaMakesTheSameSteps) {
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    for (const PixelOrder order : {PixelOrder::progressive, PixelOrder::frameless}) {
      RenderOptions options = options_of(scene_);
      options.order = order;
      options.isa = std::string(info.name);
      options.update = [&](const Film& film) { EXPECT_EQ(wrong_pixels(film), 0); };
      auto renderer = Renderer::create(scene_, options);
      ASSERT_TRUE(renderer);
      Film film(renderer.value().rect());
      EXPECT_TRUE(renderer.value().render_live(film));
    }
  }
}

TEST_F(Live, CanStopAndResumeAnywhere) {
  for (const PixelOrder order : all_orders) {
    for (const double stop_at : {0.001, 0.2, 0.5, 0.9}) {
      std::atomic<bool> cancel{false};
      RenderOptions options = options_of(scene_);
      options.order = order;
      options.threads = 1;  // only the rendering thread reports progress
      options.tile = 8;
      options.cancel = &cancel;
      bool impatient = true;
      options.progress = [&](const Progress& p) { cancel = impatient && p.share >= stop_at; };
      auto renderer = Renderer::create(scene_, options);
      Film film(renderer.value().rect());
      EXPECT_FALSE(renderer.value().render_live(film));
      EXPECT_EQ(wrong_pixels(film), 0);
      EXPECT_GT(film.total_samples(), 0u);
      EXPECT_LT(film.total_samples(), film.rect().area() * 3);
      impatient = false;
      cancel = false;
      EXPECT_TRUE(renderer.value().render_live(film));
      EXPECT_EQ(differing_pixels(film.to_image(), finished_), 0);
    }
  }
}

TEST(LivePaths, EndAsThePictureInAnyOrder) {
  Scene scene = mixed_scene(40, 30);
  scene.image.spp = 5;
  scene.render.method = Method::path;
  const Image expected = render(scene);
  for (const PixelOrder order : all_orders) {
    RenderOptions options = options_of(scene);
    options.order = order;
    auto renderer = Renderer::create(scene, options);
    ASSERT_TRUE(renderer);
    Film film(renderer.value().rect());
    EXPECT_TRUE(renderer.value().render_live(film));
    EXPECT_EQ(differing_pixels(film.to_image(), expected), 0);
  }
}

TEST_F(Live, CropsEqualTheFramesPart) {
  RenderOptions options = options_of(scene_);
  options.order = PixelOrder::progressive;
  options.crop = PixelRect{11, 6, 52, 41};
  auto renderer = Renderer::create(scene_, options);
  Film film(renderer.value().rect()), foreign({0, 0, 41, 35});
  EXPECT_TRUE(renderer.value().render_live(film));
  EXPECT_EQ(wrong_pixels(film), 0);
  EXPECT_FALSE(renderer.value().render_live(foreign));
}

}  // namespace
}  // namespace boule::test
