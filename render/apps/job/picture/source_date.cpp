#include "render/apps/job/picture/source_date.h"

#include <fmt/format.h>

#include <cstdlib>
#include <ctime>

#include "render/apps/job/options/option_values.h"

namespace boule {
namespace {

constexpr std::time_t end_of_9999 = 253402300799;

}  // namespace

Result<std::string> source_date() {
  const char* const variable = std::getenv("SOURCE_DATE_EPOCH");
  const std::string text = variable != nullptr ? variable : "0";
  const auto seconds = parse_number(text, std::time_t{0}, end_of_9999);
  std::tm date{};
  if (!seconds || gmtime_r(&*seconds, &date) == nullptr) {
    return Diagnostic::of("SOURCE_DATE_EPOCH: " + quote(text) +
                          " is not understood, expected whole seconds since 1970");
  }
  return fmt::format("{:04}:{:02}:{:02} {:02}:{:02}:{:02}", date.tm_year + 1900, date.tm_mon + 1,
                     date.tm_mday, date.tm_hour, date.tm_min, date.tm_sec);
}

}  // namespace boule
