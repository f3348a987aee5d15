#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/chunks.h"
#include "core/scene/number_text.h"
#include "render/particles/particle_colors.h"
#include "render/particles/percentiles.h"

namespace boule {
namespace {

/// A range around what is the same for all particles.
std::array<double, 2> range_around(double number) {
  const double half = std::max(std::fabs(number), 1.0) / 2;
  constexpr double most = std::numeric_limits<double>::max();
  return {std::max(number - half, -most), std::min(number + half, most)};
}

std::array<double, 2> choose_range(const ColoredFrame& colored, const ParticleNumbers& numbers,
                                   const std::string& by, std::vector<std::string>& notes) {
  const std::string name = "the colours of " + quote(by);
  if (colored.frame.size() == 0) return {0, 1};
  auto range = percentiles(numbers, colored.frame.size(), colored.parallel_for);
  if (range[0] > range[1]) return {0, 1};  // all are missing
  if (!(range[0] < range[1])) {
    notes.push_back(name + " are those of one number, " + number_text(range[0]));
    return range_around(range[0]);
  }
  notes.push_back(name + " go from " + number_text(range[0]) + " to " + number_text(range[1]) +
                  ", the 1st and 99th percentile");
  return range;
}

}  // namespace

Result<ParticleMaterials> map_numbers(const ColoredFrame& colored, const MappedColors& mapped,
                                      const std::string& key) {
  const auto numbers = find_particle_numbers(colored.frame, mapped.by, key);
  if (!numbers) return numbers.error();
  ParticleMaterials made;
  const std::array<double, 2> range =
      mapped.range ? *mapped.range : choose_range(colored, numbers.value(), mapped.by, made.notes);
  if (!(range[0] < range[1]) || !std::isfinite(range[0]) || !std::isfinite(range[1])) {
    return Diagnostic::about("color.range", "expected two finite numbers, the larger one last");
  }
  made.colors.scale = {mapped.by, mapped.map, range};
  made.materials.values.resize(colored.frame.size());
  const RangePlace place(range);
  std::vector<std::size_t> missing(chunks_of(made.materials.values.size()));
  in_chunks(colored.parallel_for, made.materials.values.size(),
            [&](std::size_t chunk, std::size_t begin, std::size_t end) {
              std::vector<double> block(end - begin);
              numbers.value().read(begin, end, block.data());
              for (std::size_t i = begin; i < end; ++i) {
                const double number = block[i - begin];
                const bool is_missing = std::isnan(number);
                missing[chunk] += is_missing ? 1 : 0;
                made.materials.values[i] =
                    colored.in(is_missing ? missing_color : mapped.map.color(place(number)));
              }
            });
  made.colors.scale->missing = std::accumulate(missing.begin(), missing.end(), std::size_t{0});
  if (const std::size_t count = made.colors.scale->missing; count > 0) {
    made.notes.push_back(std::to_string(count) +
                         (count == 1 ? " particle has" : " particles have") + " no number in " +
                         quote(mapped.by) + ", the colour of that is " + hex_text(missing_color));
  }
  return made;
}

}  // namespace boule
