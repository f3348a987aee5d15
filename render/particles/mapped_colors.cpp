#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/chunks.h"
#include "render/particles/particle_colors.h"
#include "render/particles/percentiles.h"

namespace boule {
namespace {

/// The range that the series has, or the frame by itself.
std::array<double, 2> choose_range(const ColoredFrame& colored, const ParticleNumbers& numbers,
                                   const std::string& by, ParticleMaterials& made) {
  auto& own = made.own.range;
  const bool of_series = colored.chosen != nullptr && colored.chosen->range;
  if (!of_series && colored.frame.size() > 0) {
    own = percentiles(numbers, colored.frame.size(), colored.parallel_for);
  }
  const auto& ends = of_series ? colored.chosen->range : own;
  if (!ends) return {0, 1};
  made.notes.push_back(range_note(by, *ends, of_series ? colored.chosen->of_frames : ""));
  return map_range(*ends);
}

}  // namespace

Result<ParticleMaterials> map_numbers(const ColoredFrame& colored, const MappedColors& mapped,
                                      const std::string& key) {
  const auto numbers = find_particle_numbers(colored.frame, mapped.by, key);
  if (!numbers) return numbers.error();
  ParticleMaterials made;
  const std::array<double, 2> range =
      mapped.range ? *mapped.range : choose_range(colored, numbers.value(), mapped.by, made);
  if (!(range[0] < range[1]) || !std::isfinite(range[0]) || !std::isfinite(range[1])) {
    return Diagnostic::about("color.range", "expected two finite numbers, the larger one last");
  }
  made.colors.scale = {mapped.by, mapped.map, range};
  made.materials.values.resize(colored.frame.size());
  const RangePlace place(range);
  in_chunks(colored.parallel_for, made.materials.values.size(),
            [&](std::size_t, std::size_t begin, std::size_t end) {
              std::vector<double> block(end - begin);
              numbers.value().read(begin, end, block.data());
              for (std::size_t i = begin; i < end; ++i) {
                made.materials.values[i] = colored.in(mapped.map.color(place(block[i - begin])));
              }
            });
  return made;
}

}  // namespace boule
