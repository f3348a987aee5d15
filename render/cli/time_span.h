#pragma once

#include <algorithm>
#include <chrono>

namespace boule::cli {

/// Seconds of the command line as a span of the steady clock: not for ever, so that
/// any time plus it is one.
inline std::chrono::steady_clock::duration time_span(double seconds) {
  constexpr double longest = 1e9;  // 31 years
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(std::clamp(seconds, 0.0, longest)));
}

/// The other way round.
inline double in_seconds(std::chrono::steady_clock::duration span) {
  return std::chrono::duration<double>(span).count();
}

}  // namespace boule::cli
