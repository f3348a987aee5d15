// What noise to order is worth: the error of pictures whose pixels all have as many samples, and of
// those whose pixels have as many as they need, by what they cost.
//   bench_noise SCENE [SAMPLES]     SCENE: .toml; SAMPLES of the reference, 16384 if left out

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "bench/thread_seconds.h"
#include "core/math/srgb.h"
#include "render/renderer/renderer.h"
#include "render/scene_file/scene_file.h"

namespace boule::bench {
namespace {

constexpr int width = 64, height = 36;

struct Rendered {
  MeasuredPicture picture{PixelRect{0, 0, width, height}};
  double seconds = 0, mrays = 0;
};

Rendered render(const Scene& scene, RenderOptions options) {
  options.width = width;
  options.height = height;
  options.threads = 1;
  Rendered rendered;
  Renderer renderer = Renderer::create(scene, options).value();
  const double begin = thread_seconds();
  if (renderer.render_measured(rendered.picture)) std::abort();
  rendered.seconds = thread_seconds() - begin;
  rendered.mrays = static_cast<double>(renderer.statistics().rays.total()) * 1e-6;
  return rendered;
}

/// All pixels get so many samples.
RenderOptions uniform(RenderOptions options, int spp) {
  options.noise = 1e-7F;
  options.min_spp = options.spp = spp;
  return options;
}

double displayed(float v) { return srgb_from_linear(std::clamp(static_cast<double>(v), 0.0, 1.0)); }

/// The difference of each pixel as it is shown, of the channel where it is greatest, ascending.
std::vector<double> errors_of(const MeasuredPicture& picture, const MeasuredPicture& truth) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const Color &a = picture.pixels()[i].color, &b = truth.pixels()[i].color;
    errors.push_back(std::max({std::abs(displayed(a.r) - displayed(b.r)),
                               std::abs(displayed(a.g) - displayed(b.g)),
                               std::abs(displayed(a.b) - displayed(b.b))}));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

void print(const char* kind, double asked, const Rendered& one, const MeasuredPicture& truth) {
  const std::vector<double> errors = errors_of(one.picture, truth);
  double squares = 0;
  for (const double error : errors) squares += error * error;
  const std::size_t last = errors.size() - 1;
  std::printf("%s,%g,%.1f,%.3f,%.3f,%.5f,%.5f,%.5f\n", kind, asked,
              noise_reached(one.picture, usual_max_spp).mean_samples, one.seconds, one.mrays,
              std::sqrt(squares / static_cast<double>(errors.size())), errors[last * 95 / 100],
              errors[last * 99 / 100]);
  std::fflush(stdout);
}

int run(const char* file, int reference) {
  const auto loaded = load_scene(file);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", format_diagnostic(loaded.error()).c_str());
    return 3;
  }
  const Scene& scene = loaded.value().scene;
  RenderOptions options = options_of(scene);
  options.seed = 2;
  const Rendered truth = render(scene, uniform(options, reference));
  options.seed = 1;
  std::printf("kind,asked,mean_samples,seconds,mrays,rms_error,error_of_95,error_of_99\n");
  for (int spp = 16; spp <= reference / 8; spp *= 2)
    print("uniform", spp, render(scene, uniform(options, spp)), truth.picture);
  for (const float noise : {0.32F, 0.16F, 0.08F, 0.04F, 0.02F}) {
    RenderOptions adaptive = options;
    adaptive.noise = noise;
    adaptive.min_spp = 16;
    adaptive.spp = usual_max_spp;
    print("adaptive", static_cast<double>(noise), render(scene, adaptive), truth.picture);
  }
  return 0;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  int reference = 16384;
  const std::string_view text = argc > 2 ? argv[2] : "16384";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), reference);
  if (argc < 2 || argc > 3 || error != std::errc{} || end != text.data() + text.size() ||
      reference < 256) {
    std::fprintf(stderr, "usage: bench_noise SCENE [SAMPLES], SAMPLES >= 256\n");
    return 2;
  }
  return boule::bench::run(argv[1], reference);
}
