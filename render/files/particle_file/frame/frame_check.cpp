#include "render/files/particle_file/frame/frame_check.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/geometry.h"

namespace boule {

Status check_values(const ParticleFrame& frame, bool lenient, std::uint64_t before) {
  const auto text_of = [before](std::ptrdiff_t place) {
    return "particle " + std::to_string(before + static_cast<std::uint64_t>(place) + 1);
  };
  const auto& positions = frame.positions;
  const auto wrong = std::find_if(positions.begin(), positions.end(),
                                  [](const Vec3d& point) { return !is_finite(point); });
  if (wrong != positions.end())
    return Diagnostic::of(text_of(wrong - positions.begin()) + " is at no finite position");
  if (lenient) return {};
  for (const NumberColumn& column : frame.numbers) {
    const auto& values = column.values;
    const auto infinite =
        std::find_if(values.begin(), values.end(), [](double value) { return std::isinf(value); });
    if (infinite == values.end()) continue;
    return Diagnostic::about(
        column.name, "of " + text_of(infinite - values.begin()) + ": expected a finite number");
  }
  return {};
}

}  // namespace boule
