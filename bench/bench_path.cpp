// Path tracing, measured: what share of the time goes to rays, and the error at equal time of our
// samples beside plain random ones, as figures for a plot.
//   bench_path SCENE [SAMPLES]     SCENE: .toml; SAMPLES of the reference, 4096 if left out

#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <vector>

#include "bench/median.h"
#include "render/frame/sampler.h"
#include "render/integrators/path.h"
#include "render/scene_file/scene_file.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

constexpr int width = 128, height = 72;
constexpr std::uint64_t seed = 1, reference_seed = 2;

/// Processor seconds since its construction: what else the machine does counts little.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t start_ = std::clock();
};

/// The kernels that are timed, and how long they took. Kernel tables hold plain functions, so this
/// cannot live anywhere else; one thread.
const KernelTable* timed_kernels = nullptr;
double kernel_seconds = 0;

void timed_closest_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
                       const HitStream& hits) {
  const Stopwatch watch;
  timed_kernels->closest_hit(geometry, rays, query, hits);
  kernel_seconds += watch.seconds();
}

void timed_any_hit(const GeometryView& geometry, const RayStream& rays, const Query& query,
                   std::uint8_t* occluded) {
  const Stopwatch watch;
  timed_kernels->any_hit(geometry, rays, query, occluded);
  kernel_seconds += watch.seconds();
}

/// How samples of a pixel belong together: as one sequence, or not at all, as random numbers do.
enum class Samples { sequence, random };

/// Pixels' means of more and more samples.
class Picture {
 public:
  Picture(const PreparedScene& scene, const KernelTable& kernels, int max_depth,
          std::uint64_t seed_of_picture)
      : scene_(scene),
        kernels_(kernels),
        sampler_(2, seed_of_picture),
        path_(scene, kernels, settings(max_depth, seed_of_picture)),
        sums_(width * height) {}

  /// Adds one sample to each pixel. A random one is the first of a sequence of its own, that of a
  /// pixel far away: it costs the same.
  void add(int sample, Samples samples) {
    const int away = samples == Samples::random ? 65536 * (sample + 1) : 0;
    const int index = samples == Samples::random ? 0 : sample;
    places_.resize(width * height);
    rays_.resize(width * height);
    ids_.clear();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const RasterPoint place = sampler_.position(x + away, y, index);
        places_.set(ids_.size(), place.x - away, place.y);
        ids_.push_back({x + away, y, index});
      }
    }
    radiance_.resize(ids_.size());
    kernels_.primary_rays(scene_.camera_view, places_.view(), rays_.view());
    path_.trace({rays_, scene_.coherence, ids_.data()}, radiance_.data());
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      const auto [r, g, b] = radiance_[k];
      sums_[k] = sums_[k] + vec_cast<double>(Vec3f{r, g, b});
    }
    ++count_;
  }

  /// Root of the mean square of all differences.
  [[nodiscard]] double distance_to(const Picture& other) const {
    double sum = 0;
    for (std::size_t k = 0; k < sums_.size(); ++k) {
      const Vec3d d = sums_[k] * (1.0 / count_) - other.sums_[k] * (1.0 / other.count_);
      sum += dot(d, d) / 3;
    }
    return std::sqrt(sum / static_cast<double>(sums_.size()));
  }

  [[nodiscard]] RayCounts counts() const { return path_.counts(); }

 private:
  static IntegratorSettings settings(int max_depth, std::uint64_t seed_of_picture) {
    IntegratorSettings settings;
    settings.max_depth = max_depth;
    settings.seed = seed_of_picture;
    return settings;
  }

  const PreparedScene& scene_;
  const KernelTable& kernels_;
  Sampler sampler_;
  Path path_;
  std::vector<Vec3d> sums_;
  int count_ = 0;
  SampleBuffer places_;
  RayBuffer rays_;
  std::vector<SampleId> ids_;
  std::vector<Color> radiance_;
};

/// Rays per second of the whole, and of the kernels that trace them, in one run: the same rays.
void measure_speed(const PreparedScene& scene, const KernelTable& kernels, int max_depth) {
  timed_kernels = &kernels;
  KernelTable timed = kernels;
  timed.closest_hit = timed_closest_hit;
  timed.any_hit = timed_any_hit;
  std::vector<double> whole, traversal, ratio;
  for (int run = 0; run < 9; ++run) {
    Picture picture(scene, timed, max_depth, seed);
    kernel_seconds = 0;
    const Stopwatch watch;
    for (int sample = 0; sample < 16; ++sample) picture.add(sample, Samples::sequence);
    const double seconds = watch.seconds();
    const double rays = static_cast<double>(picture.counts().total()) * 1e-6;
    whole.push_back(rays / seconds);
    traversal.push_back(rays / kernel_seconds);
    ratio.push_back(kernel_seconds / seconds);
  }
  std::printf("isa %s: %.2f Mray/s path traced, %.2f traversal only, ratio %.3f (medians of 9)\n",
              std::string(isa_name(kernels.isa)).c_str(), median(whole), median(traversal),
              median(ratio));
}

void measure_errors(const PreparedScene& scene, const KernelTable& kernels, int max_depth,
                    int most) {
  Picture reference(scene, kernels, max_depth, reference_seed);
  for (int sample = 0; sample < most; ++sample) reference.add(sample, Samples::sequence);
  Picture ours(scene, kernels, max_depth, seed), random(scene, kernels, max_depth, seed);
  double our_seconds = 0, random_seconds = 0;
  std::printf("samples,seconds,rms_error,random_seconds,random_rms_error\n");
  for (int sample = 0; sample < most / 8; ++sample) {
    const Stopwatch our_watch;
    ours.add(sample, Samples::sequence);
    our_seconds += our_watch.seconds();
    const Stopwatch random_watch;
    random.add(sample, Samples::random);
    random_seconds += random_watch.seconds();
    const int n = sample + 1;
    if ((n & (n - 1)) != 0) continue;  // powers of two
    std::printf("%d,%.4f,%.6f,%.4f,%.6f\n", n, our_seconds, ours.distance_to(reference),
                random_seconds, random.distance_to(reference));
  }
}

int run(const char* file, int most) {
  auto loaded = load_scene(file);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", format_diagnostic(loaded.error()).c_str());
    return 3;
  }
  Scene scene = std::move(loaded).value().scene;
  const int max_depth = scene.render.max_depth;
  const auto prepared = prepare(std::move(scene), width, height, serial_for, Method::path);
  if (!prepared) return 3;
  const KernelTable& kernels = *select_kernels("auto").value();
  measure_speed(prepared.value(), kernels, max_depth);
  measure_errors(prepared.value(), kernels, max_depth, most);
  return 0;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  int most = 4096;
  const std::string_view text = argc > 2 ? argv[2] : "4096";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), most);
  if (argc < 2 || argc > 3 || error != std::errc{} || end != text.data() + text.size() ||
      most < 8) {
    std::fprintf(stderr, "usage: bench_path SCENE [SAMPLES], SAMPLES >= 8\n");
    return 2;
  }
  return boule::bench::run(argv[1], most);
}
