#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/error.h"

namespace boule {

/// A column, by its name.
struct ColumnName {
  std::string name;
  std::size_t place = 0;  ///< in the expression, in characters from 1
};
/// What stands on one side of a comparison: a number, a column, or a text that was quoted.
using SelectValue = std::variant<double, ColumnName, std::string>;

enum class Comparison { less, less_equal, equal, not_equal, greater_equal, greater };

/// One step of an expression as a stack takes it: a comparison puts its outcome on the stack,
/// `negate` changes the topmost, `both` and `either` make one of the two topmost.
struct SelectStep {
  enum class Kind { compare, negate, both, either };
  Kind kind = Kind::compare;
  SelectValue left{}, right{};
  Comparison comparison{};
  std::size_t place = 0;  ///< of the comparison's sign, in characters from 1
};

/// A condition on particles, "type == 1 && (x > 0 || !(species == \"Fe\"))", in the order in which
/// it is calculated. && binds closer than ||; '...' and "..." quote texts.
struct SelectExpression {
  std::vector<SelectStep> steps;  ///< at least one

  /// How many outcomes the stack holds at most.
  [[nodiscard]] std::size_t depth() const;
};

/// Reads an expression. The error's message tells the character, from 1, and its key is `key`.
/// Names begin with a letter or _ and go on with those, digits, '.', ':' and brackets, as in
/// "c_1[2]"; "|v|" is a name too (MappedColors).
Result<SelectExpression> parse_select(std::string_view text, const std::string& key);

}  // namespace boule
