#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/text.h"

namespace boule {

/// The nearest double to a decimal number in any notation: "1", "-.5", "+1e3", Fortran's "1.5D+02",
/// "nan", "inf"; too large a number gives infinity. Nothing for any other text.
std::optional<double> number_in(std::string_view token);

/// A whole number from 0 on; nothing for any other text, and for numbers above 2^64 - 1.
std::optional<std::uint64_t> count_in(std::string_view token);

/// True for what tables have in place of a number that is not there: nothing, "nan", "null", "NA",
/// "n/a", "none", "--", "-" and the like, in any case.
bool is_missing_text(std::string_view token);

/// A number with a decimal comma as one with a point; other texts as they are.
std::string with_decimal_point(std::string_view token);

/// 1 for "T", "true", "True", "TRUE", and 0 for the same of false; nothing for any other text.
std::optional<double> logical_in(std::string_view token);

/// Reads the decimal number that a text begins with, correctly rounded. Returns where it ends, or
/// null where there is none, or one that is not finite.
const char* number_at(const char* at, const char* end, double& value);

}  // namespace boule
