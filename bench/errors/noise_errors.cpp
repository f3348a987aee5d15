#include "bench/errors/noise_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>

#include "bench/tools/thread_seconds.h"
#include "core/math/srgb.h"
#include "render/renderer/renderer.h"

namespace boule::bench {
namespace {

constexpr std::uint64_t seed_of_errors = 1, seed_of_reference = 1'000'000;

/// Colours of a picture, as they are displayed.
using Shown = std::vector<Vec3d>;

Shown shown(const Image& image) {
  Shown colors;
  for (const auto& [r, g, b] : image.pixels) {
    const auto [x, y, z] = vec_cast<double>(Vec3f{r, g, b});
    colors.push_back({srgb_displayed(x), srgb_displayed(y), srgb_displayed(z)});
  }
  return colors;
}

RenderOptions options_for(const Scene& scene, const NoiseSettings& settings) {
  RenderOptions options = options_of(scene);
  options.width = settings.width;
  options.height = settings.height;
  options.noise = 0;
  options.outline = 0;
  options.transparent = false;
  return options;
}

/// Processor seconds of rendering that must not fail.
double seconds_of(const auto& render) {
  const double begin = thread_seconds();
  if (!render()) std::abort();
  return thread_seconds() - begin;
}

/// The pictures of one scene, which is prepared once, and their errors.
class NoisePictures {
 public:
  NoisePictures(const Scene& scene, const NoiseSettings& settings)
      : options_(options_for(scene, settings)),
        most_spp_(std::min(usual_max_spp, settings.reference / 8)),
        scene_(std::make_shared<PreparedScene>(
            prepare(scene, options_.width, options_.height, serial_for, options_.method).value())) {
    options_.spp = settings.reference;
    options_.seed = seed_of_reference;
    options_.threads = settings.threads;
    reference_ = shown(create().render().value());
    options_.threads = 1;
    sums_.resize(reference_.size());
  }

  NoiseError uniform(int spp) {
    options_.noise = 0;
    options_.spp = spp;
    options_.seed = seed_of_errors;
    Renderer renderer = create();
    Film film(renderer.rect());
    const double seconds = seconds_of([&] { return renderer.render_pass(film, spp); });
    return judged(shown(film.to_image()), {.asked = static_cast<double>(spp),
                                           .mean_samples = static_cast<double>(spp),
                                           .seconds = seconds,
                                           .mrays = mrays_of(renderer)});
  }

  NoiseError to_order(float noise) {
    options_.noise = noise;
    options_.min_spp = 16;
    options_.spp = most_spp_;
    options_.seed = seed_of_errors;
    Renderer renderer = create();
    MeasuredPicture picture(renderer.rect());
    const double seconds = seconds_of([&] { return renderer.render_measured(picture); });
    return judged(shown(picture.image(Alpha::none)),
                  {.asked = static_cast<double>(noise),
                   .mean_samples = noise_reached(picture, options_.spp).mean_samples,
                   .seconds = seconds,
                   .mrays = mrays_of(renderer)});
  }

  /// Adds samples that do not know of each other, each the first one of another seed, until there
  /// are as many.
  NoiseError random(int spp) {
    options_.noise = 0;
    options_.spp = 2;  // of which one is rendered; a single one would lie at the pixel's centre
    for (; random_.asked < spp; ++random_.asked) {
      options_.seed = seed_of_errors + static_cast<std::uint64_t>(random_.asked);
      Renderer renderer = create();
      Film film(renderer.rect());
      random_.seconds += seconds_of([&] { return renderer.render_pass(film, 1); });
      const Image image = film.to_image();
      random_.mrays += mrays_of(renderer);
      for (std::size_t i = 0; i < sums_.size(); ++i) {
        const auto& [r, g, b] = image.pixels[i];
        sums_[i] = sums_[i] + vec_cast<double>(Vec3f{r, g, b});
      }
    }
    random_.mean_samples = random_.asked;
    Shown means;
    for (const Vec3d& sum : sums_) {
      const Vec3d mean = sum * (1.0 / spp);
      means.push_back({srgb_displayed(mean.x), srgb_displayed(mean.y), srgb_displayed(mean.z)});
    }
    return judged(means, random_);
  }

 private:
  Renderer create() { return Renderer::create(scene_, options_).value(); }

  static double mrays_of(const Renderer& renderer) {
    return static_cast<double>(renderer.statistics().rays.total()) * 1e-6;
  }

  /// The same with the picture's errors.
  [[nodiscard]] NoiseError judged(const Shown& picture, NoiseError error) const {
    std::vector<double> errors;
    double squares = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const Vec3d d = picture[i] - reference_[i];
      errors.push_back(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
      squares += errors.back() * errors.back();
    }
    std::sort(errors.begin(), errors.end());
    const std::size_t last = errors.size() - 1;
    error.rms = std::sqrt(squares / static_cast<double>(errors.size()));
    error.within_95 = errors[last * 95 / 100];
    error.within_99 = errors[last * 99 / 100];
    return error;
  }

  RenderOptions options_;
  int most_spp_;  ///< of noise to order: the reference knows better than any pixel
  std::shared_ptr<const PreparedScene> scene_;
  Shown reference_;
  std::vector<Vec3d> sums_;  ///< of random samples
  NoiseError random_;
};

}  // namespace

NoiseErrors measure_noise_errors(const Scene& scene, const NoiseSettings& settings) {
  NoisePictures pictures(scene, settings);
  NoiseErrors errors;
  for (int spp = 16; spp <= settings.reference / 16; spp *= 2) {
    errors.uniform.push_back(pictures.uniform(spp));
    errors.random.push_back(pictures.random(spp));
  }
  for (const float noise : {0.16F, 0.08F, 0.04F, 0.02F})
    errors.to_order.push_back(pictures.to_order(noise));
  return errors;
}

double seconds_until(double error, const std::vector<NoiseError>& errors) {
  const auto after = std::find_if(errors.begin(), errors.end(),
                                  [&](const NoiseError& e) { return e.within_99 <= error; });
  if (after == errors.begin()) return after->seconds;
  const NoiseError& before = *(after - 1);
  const double share = std::log(before.within_99 / error);
  if (after == errors.end()) return before.seconds * std::exp(2 * share);
  const double slope =
      std::log(after->seconds / before.seconds) / std::log(before.within_99 / after->within_99);
  return before.seconds * std::exp(share * slope);
}

}  // namespace boule::bench
