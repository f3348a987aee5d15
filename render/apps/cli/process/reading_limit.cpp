#include "render/apps/cli/process/reading_limit.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "render/apps/cli/process/exit_code.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/time_span.h"

namespace boule::cli {

ReadingLimit::ReadingLimit(std::optional<double> limit)
    : limit_(limit), left_(time_span(limit.value_or(0))) {
  if (limit_) pulse_.emplace([this](Clock::time_point now) { return beat(now); });
}

ReadingLimit::Clock::time_point ReadingLimit::beat(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  leave_if_over(now);
  return end_.value_or(Clock::time_point::max());
}

void ReadingLimit::leave_if_over(Clock::time_point now) const {
  if (end_ && now >= *end_) leave_at_once(error_.c_str(), failed);
}

ReadingLimit::Reading::Reading(ReadingLimit& limit, const std::string& file) : limit_(limit) {
  if (!limit.limit_) return;
  const std::lock_guard lock(limit.mutex_);
  limit.error_ = fmt::format("boule: error: reading {} took longer than --load-limit {:g} s\n",
                             quote(file, 300), *limit.limit_);
  limit.end_ = Clock::now() + limit.left_;
  limit.pulse_->at(*limit.end_);
}

ReadingLimit::Reading::~Reading() {
  if (!limit_.limit_) return;
  const std::lock_guard lock(limit_.mutex_);
  const auto now = Clock::now();
  limit_.leave_if_over(now);
  limit_.left_ = *limit_.end_ - now;
  limit_.end_.reset();
}

}  // namespace boule::cli
