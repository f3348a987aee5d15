#pragma once

#include <algorithm>
#include <chrono>

namespace boule::cli {

/// Seconds of the command line as a span of the steady clock, at most 31 years, so that adding it
/// to a time does not overflow.
inline std::chrono::steady_clock::duration time_span(double seconds) {
  constexpr double longest = 1e9;
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(std::clamp(seconds, 0.0, longest)));
}

/// A span in seconds.
inline double in_seconds(std::chrono::steady_clock::duration span) {
  return std::chrono::duration<double>(span).count();
}

}  // namespace boule::cli
