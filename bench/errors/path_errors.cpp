#include "bench/errors/path_errors.h"

#include <cmath>
#include <utility>

#include "bench/tools/thread_seconds.h"
#include "core/optics/cameras.h"
#include "render/files/scene_file/scene_file.h"

namespace boule::bench {
namespace {

constexpr std::uint64_t seed_of_errors = 1, seed_of_reference = 2;

IntegratorSettings path_settings(int max_depth, std::uint64_t seed) {
  IntegratorSettings settings;
  settings.max_depth = max_depth;
  settings.seed = seed;
  return settings;
}

}  // namespace

Result<PathScene> load_path_scene(const std::string& file) {
  auto loaded = load_scene(file);
  if (!loaded) return loaded.error();
  Scene scene = std::move(loaded).value().scene;
  const int max_depth = scene.render.max_depth;
  auto prepared =
      prepare(std::move(scene), PathPicture::width, PathPicture::height, serial_for, Method::path);
  if (!prepared) return prepared.error();
  const CameraView& camera = prepared.value().camera_view;
  if (has_lens(camera.kind) || camera.weighs) {
    return Diagnostic{
        .message = "expected a pinhole or orthographic camera", .key = "camera.type", .file = file};
  }
  return PathScene{std::move(prepared).value(), max_depth};
}

PathPicture::PathPicture(const PathScene& scene, const KernelTable& kernels, std::uint64_t seed)
    : scene_(scene.prepared),
      kernels_(kernels),
      sampler_(2, seed),
      path_(scene.prepared, kernels, path_settings(scene.max_depth, seed)),
      sums_(width * height) {}

void PathPicture::add(int sample, Samples samples) {
  const int away = samples == Samples::random ? 65536 * (sample + 1) : 0;
  const int index = samples == Samples::random ? 0 : sample;
  places_.resize(width * height);
  numbers_.resize(width * height);
  rays_.resize(width * height, common_part(scene_.camera_view.kind));
  ids_.clear();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      numbers_.ask(ids_.size(), sampler_.key(x + away, y), RandomSet::film,
                   static_cast<std::uint32_t>(index));
      ids_.push_back({x + away, y, index});
    }
  }
  numbers_.find(kernels_, ids_.size());
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    const RasterPoint place = sampler_.position(ids_[k].x - away, ids_[k].y, numbers_.get(k));
    places_.set(k, place.x, place.y);
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

double PathPicture::distance_to(const PathPicture& other) const {
  double sum = 0;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const Vec3d d = sums_[k] * (1.0 / count_) - other.sums_[k] * (1.0 / other.count_);
    sum += dot(d, d) / 3;
  }
  return std::sqrt(sum / static_cast<double>(sums_.size()));
}

PathErrors measure_path_errors(const PathScene& scene, const KernelTable& kernels, int reference) {
  PathPicture truth(scene, kernels, seed_of_reference);
  for (int sample = 0; sample < reference; ++sample) truth.add(sample, Samples::sequence);
  PathErrors errors;
  PathPicture sequence(scene, kernels, seed_of_errors);
  PathPicture random(scene, kernels, seed_of_errors);
  double sequence_seconds = 0, random_seconds = 0;
  for (int sample = 0; sample < reference / 8; ++sample) {
    const double begin = thread_seconds();
    sequence.add(sample, Samples::sequence);
    const double middle = thread_seconds();
    random.add(sample, Samples::random);
    sequence_seconds += middle - begin;
    random_seconds += thread_seconds() - middle;
    const int n = sample + 1;
    if ((n & (n - 1)) != 0) continue;  // powers of two
    errors.sequence.push_back({n, sequence_seconds, sequence.distance_to(truth)});
    errors.random.push_back({n, random_seconds, random.distance_to(truth)});
  }
  return errors;
}

}  // namespace boule::bench
