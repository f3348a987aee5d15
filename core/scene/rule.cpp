#include "core/scene/rule.h"

#include <cmath>

#include "core/scene/number_text.h"

namespace boule {

bool NumberRule::allows(double x) const {
  const bool above = takes_low ? x >= low : x > low;
  const bool below = takes_high ? x <= high : x < high;
  return std::isfinite(x) && above && below;
}

std::string describe(const NumberRule& rule) {
  const std::string low = number_text(rule.low), high = number_text(rule.high);
  const std::string least = rule.takes_low ? low + " or above" : "above " + low;
  if (std::isinf(rule.low)) return "finite";
  if (std::isinf(rule.high)) return "finite and " + least + rule.unit;
  if (rule.takes_low && rule.takes_high) return "from " + low + " to " + high + rule.unit;
  return least + (rule.takes_high ? " and at most " : " and below ") + high + rule.unit;
}

std::string describe(const WholeRule& rule) {
  const bool has_end = rule.high != std::numeric_limits<int>::max();
  return std::to_string(rule.low) + (has_end ? " to " + std::to_string(rule.high) : " or above");
}

}  // namespace boule
