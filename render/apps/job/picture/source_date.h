#pragma once

#include <string>

#include "core/base/error.h"

namespace boule {

/// The time stamp of files, in UTC as EXIF writes it: the time in the environment variable
/// SOURCE_DATE_EPOCH (whole seconds since 1970, up to the year 9999), or "1970:01:01 00:00:00"
/// where it is not set. An error if the variable holds anything else.
Result<std::string> source_date();

}  // namespace boule
