#include "render/renderer/block_worker.h"

#include <cmath>
#include <utility>

#include "render/renderer/live_rays.h"

namespace boule {
namespace {

/// The radiance of a sample times its weight, settled(). An infinite weight counts as NaN.
Color weighed(const Color& radiance, float weight, SampleFaults& faults) {
  return settled(radiance * (std::isfinite(weight) ? weight : std::nanf("")), faults);
}

void add(Film& film, const SampleId& id, const Color& sample, std::uint8_t covered) {
  film.add(id.x, id.y, sample, covered);
}
void add(NoiseBlock& noise, const SampleId& id, const Color& sample, std::uint8_t covered) {
  noise.add(id, sample, covered);
}
void add(EdgeBlock& edges, const SampleId& id, const Color& sample, std::uint8_t covered) {
  edges.add(id, sample, covered);
}

}  // namespace

BlockWorker::BlockWorker(const BlockSetup& setup, std::unique_ptr<Integrator> integrator)
    : setup_(setup),
      integrator_(std::move(integrator)),
      ids_(setup.stream_size),
      found_(setup.scene.camera_view, setup.kernels, setup.sampler, setup.stream_size),
      radiance_(setup.stream_size),
      covered_(setup.alpha == Alpha::none ? 0 : setup.stream_size) {}

/// Renders a block until the pixels (x, y) of the frame for which wanted(x, y) holds have `until`
/// samples.
template <class Wanted>
bool BlockWorker::render_wanted(const PixelRect& block, int until, Film& film,
                                const Wanted& wanted) {
  SampleId* const ids = ids_.data();
  const std::size_t room = ids_.size();
  std::size_t count = 0;
  for (const PixelOffset& offset : setup_.block_pixels) {
    const int x = block.x0 + offset.x, y = block.y0 + offset.y;
    if (x >= block.x1 || y >= block.y1 || !wanted(x, y)) continue;
    if (add_bare(film, x, y, film.samples(x, y), until)) continue;
    for (int sample = film.samples(x, y); sample < until; ++sample) {
      ids[count++] = {x, y, sample};
      if (count < room) continue;
      if (!trace(film, count)) return false;
      count = 0;
    }
  }
  return trace(film, count);
}

bool BlockWorker::render(const PixelRect& block, int until, Film& film) {
  return render_wanted(block, until, film, [](int, int) { return true; });
}

bool BlockWorker::render(const PixelRect& block, const LivePass& pass, Film& film) {
  return render_wanted(block, pass.until, film,
                       [&pick = pass.pick](int x, int y) { return pick.takes(x, y); });
}

bool BlockWorker::render(const PixelRect& block, int until, Image& image, const PixelRect& rect) {
  if (setup_.noise.half_width > 0 || setup_.edges.step > 0) {
    MeasuredPicture measured(block);
    const bool is_whole = measure(block, measured);
    measured.copy_to(image, rect);
    return is_whole;
  }
  block_film_.restart(block);
  const bool whole = render(block, until, block_film_);
  block_film_.copy_to(image, rect);
  return whole;
}

bool BlockWorker::measure(const PixelRect& block, MeasuredPicture& picture) {
  if (setup_.edges.step > 0) {
    if (!edges_) edges_.emplace(setup_.edges, setup_.small_spheres);
    return measure_parts(block, *edges_, picture);
  }
  if (!noise_) noise_.emplace(setup_.noise);
  return measure_parts(block, *noise_, picture);
}

template <class Part>
bool BlockWorker::measure_parts(const PixelRect& block, Part& part, MeasuredPicture& picture) {
  const BlockOrder parts(block, Part::largest, PixelOrder::tiles);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!measure_part(parts[i], part, picture)) return false;
  }
  return true;
}

template <class Part>
bool BlockWorker::measure_part(const PixelRect& rect, Part& part, MeasuredPicture& picture) {
  part.begin(rect, setup_.frame);
  for (bool more = true; more;) {
    std::size_t count = 0;
    for (const auto& wanted : part.wanted()) {
      if (add_bare(part, wanted.x, wanted.y, part.first(), part.end())) continue;
      for (int sample = part.first(); sample < part.end(); ++sample) {
        ids_[count++] = {wanted.x, wanted.y, sample};
        if (count < ids_.size()) continue;
        if (!trace(part, count)) return false;
        count = 0;
      }
    }
    if (!trace(part, count)) return false;
    more = part.look(picture);
    if (setup_.live != nullptr) setup_.live->add_measured(part.settled());
  }
  return true;
}

/// Adds the samples `first` to `end` - 1 of a bare pixel, which need no rays. False: it is another
/// pixel.
template <class Target>
bool BlockWorker::add_bare(Target& target, int x, int y, int first, int end) const {
  if (!setup_.bare_pixels.is_bare(NoiseBlock::column(x), y)) return false;
  const std::uint8_t covered = setup_.alpha == Alpha::none ? whole_coverage : 0;
  for (int sample = first; sample < end; ++sample)
    add(target, {x, y, sample}, setup_.bare_pixels.color(), covered);
  return true;
}

/// Traces the first `count` samples of ids_ and adds them to the film, or to the measurement of
/// noise or edges.
template <class Target>
bool BlockWorker::trace(Target& target, std::size_t count) {
  if (count == 0) return true;
  const std::span ids = std::span<const SampleId>(ids_).first(count);
  found_.find(ids);
  return setup_.scene.camera_view.weighs ? trace_weighted(target, ids) : trace_all(target, ids);
}

CameraRays BlockWorker::camera_rays(const SampleId* samples) {
  return {found_.rays(), setup_.scene.coherence, samples,
          covered_.empty() ? nullptr : covered_.data()};
}

template <class Target>
bool BlockWorker::trace_all(Target& target, std::span<const SampleId> ids) {
  if (!integrator_->trace(camera_rays(ids.data()), radiance_.data())) return false;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    add(target, ids[k], radiance_[k], covered(k));
  }
  return true;
}

/// Traces the samples that have a ray. A sample without a ray counts as black and uncovered.
template <class Target>
bool BlockWorker::trace_weighted(Target& target, std::span<const SampleId> ids) {
  const SampleBuffer& samples = found_.samples();
  keep_live_rays(samples, found_.rays());
  live_.clear();
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (samples.weight(k) != 0) live_.push_back(ids[k]);
  }
  if (!integrator_->trace(camera_rays(live_.data()), radiance_.data())) return false;
  std::size_t ray = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const float weight = samples.weight(k);
    if (weight == 0) {
      add(target, ids[k], Color{}, 0);
    } else {
      add(target, ids[k], weighed(radiance_[ray], weight, weighing_), covered(ray));
      ++ray;
    }
  }
  return true;
}

}  // namespace boule
