// What noise to order is worth: the error of pictures whose pixels all have as many samples, of one
// sequence or at random, and of those whose pixels have as many as they need, by what they cost.
//   bench_noise SCENE [SAMPLES [WIDTHxHEIGHT]]     SCENE: .toml; SAMPLES of the reference, 4096
//                                                  if left out

#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/errors/noise_errors.h"
#include "render/files/scene_file/scene_file.h"

namespace boule::bench {
namespace {

void print(const char* kind, const std::vector<NoiseError>& errors) {
  for (const NoiseError& e : errors) {
    std::printf("%s,%g,%.1f,%.3f,%.3f,%.5f,%.5f,%.5f\n", kind, e.asked, e.mean_samples, e.seconds,
                e.mrays, e.rms, e.within_95, e.within_99);
  }
}

/// At the error of each picture with noise to order: how many times as long the others take.
void print_ratios(const NoiseErrors& errors) {
  for (const NoiseError& e : errors.to_order) {
    std::printf("noise %g: 99 %% within %.4f; uniform takes %.2f times as long, random %.2f\n",
                e.asked, e.within_99, seconds_until(e.within_99, errors.uniform) / e.seconds,
                seconds_until(e.within_99, errors.random) / e.seconds);
  }
}

int run(const char* file, const NoiseSettings& settings) {
  const auto loaded = load_scene(file);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", format_diagnostic(loaded.error()).c_str());
    return 3;
  }
  const NoiseErrors errors = measure_noise_errors(loaded.value().scene, settings);
  std::printf("kind,asked,mean_samples,seconds,mrays,rms_error,error_of_95,error_of_99\n");
  print("uniform", errors.uniform);
  print("random", errors.random);
  print("to order", errors.to_order);
  print_ratios(errors);
  return 0;
}

/// True if the whole text was understood.
bool parse(int argc, char** argv, NoiseSettings& settings) {
  if (argc < 2 || argc > 4) return false;
  char rest = 0;
  if (argc > 2 && std::sscanf(argv[2], "%d%c", &settings.reference, &rest) != 1) return false;
  if (argc > 3 && std::sscanf(argv[3], "%dx%d%c", &settings.width, &settings.height, &rest) != 2)
    return false;
  return settings.reference >= 256 && settings.width > 0 && settings.height > 0;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  boule::bench::NoiseSettings settings;
  settings.threads = 0;
  if (boule::bench::parse(argc, argv, settings)) return boule::bench::run(argv[1], settings);
  std::fprintf(stderr, "usage: bench_noise SCENE [SAMPLES [WIDTHxHEIGHT]], SAMPLES >= 256\n");
  return 2;
}
