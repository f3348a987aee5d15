#include "render/renderer/sample_rays.h"

#include "core/optics/cameras.h"
#include "render/renderer/edge_block.h"
#include "render/renderer/noise_block.h"

namespace boule {

void SampleRays::find(std::span<const SampleId> ids) {
  place(ids);
  rays_.resize(ids.size(), common_part(camera_.kind));
  kernels_.primary_rays(camera_, samples_.view(), rays_.view());
}

/// Finds the positions of the samples on the film and on the lens.
void SampleRays::place(std::span<const SampleId> ids) {
  samples_.resize(most_, camera_);
  samples_.resize(ids.size());
  const bool centered = sampler_.single() || ids[0].sample == EdgeBlock::center;
  if (!centered) find_numbers(ids, RandomSet::film);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const SampleId& id = ids[k];
    const RasterPoint point =
        centered ? RasterPoint{NoiseBlock::column(id.x) + 0.5, id.y + 0.5}
                 : sampler_.position(NoiseBlock::column(id.x), id.y, numbers_.get(k));
    samples_.set(k, point.x, point.y);
  }
  if (!has_lens(camera_.kind)) return;
  if (!sampler_.single()) find_numbers(ids, RandomSet::lens);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const UnitPair on_lens = sampler_.single() ? UnitPair{0.5, 0.5} : numbers_.get(k);
    samples_.set_lens(k, on_lens.u, on_lens.v);
  }
}

void SampleRays::find_numbers(std::span<const SampleId> ids, RandomSet set) {
  numbers_.resize(most_);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const auto& [x, y, sample] = ids[k];
    numbers_.ask(k, sampler_.key(x, y), set, static_cast<std::uint32_t>(sample));
  }
  numbers_.find(kernels_, ids.size());
}

}  // namespace boule
