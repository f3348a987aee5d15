#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace boule {

/// A value and its time.
struct TimedValue {
  double time, value;
};

/// The index of the last of `values` at or before `time`, otherwise of the first; 0 for an empty
/// list. Precondition, here and of monotone_cubic(): the times grow strictly.
inline std::size_t value_before(std::span<const TimedValue> values, double time) {
  const auto after =
      std::upper_bound(values.begin(), values.end(), time,
                       [](double when, const TimedValue& value) { return when < value.time; });
  return after == values.begin() ? 0 : static_cast<std::size_t>(after - values.begin()) - 1;
}

namespace detail {

/// Slope between values i and i + 1.
inline double chord(std::span<const TimedValue> values, std::size_t i) {
  return (values[i + 1].value - values[i].value) / (values[i + 1].time - values[i].time);
}

/// Steffen's slope at value i: that of the parabola through it and its neighbours, limited so that
/// the curve stays between the values; at an end, that of the chord there.
inline double steffen_slope(std::span<const TimedValue> values, std::size_t i) {
  if (values.size() == 1) return 0;
  if (i == 0) return chord(values, 0);
  if (i + 1 == values.size()) return chord(values, i - 1);
  const double before = chord(values, i - 1), after = chord(values, i);
  if (!(before * after > 0)) return 0;
  const double h0 = values[i].time - values[i - 1].time, h1 = values[i + 1].time - values[i].time;
  const double parabola = (before * h1 + after * h0) / (h0 + h1);
  const double limit = std::min(std::fabs(before), std::fabs(after));
  const double slope = std::min(2 * limit, std::fabs(parabola));
  return before < 0 ? -slope : slope;
}

}  // namespace detail

/// The cubic interpolation of Steffen ("A simple method for monotonic interpolation in one
/// dimension", Astronomy and Astrophysics 239, 1990). It is smooth (C1) and exact at each time, and
/// it stays between two neighbouring values. Before the first time and after the last it is
/// constant. NaN for an empty list.
inline double monotone_cubic(std::span<const TimedValue> values, double time) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t i = value_before(values, time);
  const TimedValue& from = values[i];
  if (i + 1 == values.size() || time <= from.time) return from.value;
  const TimedValue& to = values[i + 1];
  const double h = to.time - from.time, x = time - from.time, s = detail::chord(values, i);
  const double begin = detail::steffen_slope(values, i);
  const double end = detail::steffen_slope(values, i + 1);
  const double a = (begin + end - 2 * s) / (h * h), b = (3 * s - 2 * begin - end) / h;
  const double value = ((a * x + b) * x + begin) * x + from.value;
  return std::clamp(value, std::min(from.value, to.value), std::max(from.value, to.value));
}

}  // namespace boule
