#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/chunks.h"
#include "render/files/particles/colors/particle_colors.h"
#include "render/files/particles/colors/percentiles.h"

namespace boule {
namespace {

/// Numbers on both sides of 0: as far to one side as to the other.
std::array<double, 2> around_0(const std::array<double, 2>& ends) {
  if (!(ends[0] < 0 && ends[1] > 0)) return ends;
  const double farthest = std::max(-ends[0], ends[1]);
  return {-farthest, farthest};
}

/// The range that the series has, or the frame by itself.
std::array<double, 2> choose_range(const ColoredFrame& colored, const ParticleNumbers& numbers,
                                   const std::string& by, bool is_diverging,
                                   ParticleMaterials& made) {
  auto& own = made.own.range;
  const ParticleChoices* const chosen = colored.style.chosen;
  const bool of_series = chosen != nullptr && chosen->range;
  if (!of_series && colored.frame.size() > 0) {
    own = percentiles(numbers, colored.frame.size(), colored.parallel_for);
    if ((*own)[0] > (*own)[1]) own.reset();  // all are missing
  }
  const auto& ends = of_series ? chosen->range : own;
  if (!ends) return {0, 1};
  const auto around = is_diverging ? around_0(*ends) : *ends;
  made.notes.push_back(range_note(by, around, of_series ? chosen->of_frames : "") +
                       (around == *ends ? "" : ", the same on both sides of 0"));
  return map_range(around);
}

}  // namespace

Result<ParticleMaterials> map_numbers(const ColoredFrame& colored, const MappedColors& mapped,
                                      const std::string& key) {
  const auto numbers = find_particle_numbers(colored.frame, mapped.by, key);
  if (!numbers) return numbers.error();
  ParticleMaterials made;
  const std::array<double, 2> range =
      mapped.range
          ? *mapped.range
          : choose_range(colored, numbers.value(), mapped.by, mapped.map.is_diverging(), made);
  if (!(range[0] < range[1]) || !std::isfinite(range[0]) || !std::isfinite(range[1])) {
    return Diagnostic::about("color.range", "expected two finite numbers, the larger one last");
  }
  const SrgbColor nan_color = colored.style.nan_color;
  made.colors.scale = {mapped.by, mapped.map, range, nan_color};
  made.materials.values.resize(colored.frame.size());
  const RangePlace place(range);
  struct Outside {
    std::size_t missing = 0;
    bool below = false, above = false;
  };
  std::vector<Outside> outside(chunks_of(made.materials.values.size()));
  in_chunks(colored.parallel_for, made.materials.values.size(),
            [&](std::size_t chunk, std::size_t begin, std::size_t end) {
              std::vector<double> block(end - begin);
              numbers.value().read(begin, end, block.data());
              for (std::size_t i = begin; i < end; ++i) {
                const double number = block[i - begin];
                const bool is_missing = std::isnan(number);
                Outside& found = outside[chunk];
                found.missing += is_missing ? 1 : 0;
                found.below = found.below || number < range[0];
                found.above = found.above || number > range[1];
                made.materials.values[i] =
                    colored.in(is_missing ? nan_color : mapped.map.color(place(number)));
              }
            });
  ParticleColors::Scale& scale = *made.colors.scale;
  scale.goes_below = scale.goes_above = !mapped.range && colored.style.chosen != nullptr;
  for (const Outside& one : outside) {
    scale.missing += one.missing;
    scale.goes_below = scale.goes_below || one.below;
    scale.goes_above = scale.goes_above || one.above;
  }
  if (scale.missing > 0) made.notes.push_back(missing_note(scale));
  return made;
}

std::string missing_note(const ParticleColors::Scale& scale) {
  return std::to_string(scale.missing) +
         (scale.missing == 1 ? " particle has" : " particles have") + " no number in " +
         quote(scale.by) + ", the colour of that is " + hex_text(scale.nan_color);
}

}  // namespace boule
