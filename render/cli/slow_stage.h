#pragma once

#include <string>

namespace boule::cli {

/// A stage of the work that cannot tell how far it has come, and mostly takes no time. While it
/// lives, a line is written to standard error when the stage takes a second, and every ten seconds
/// from then on. (What the system does not let run, for others' sake, is not told of at once.) One
/// at a time, and not beside a StopGuard, which has the same clock.
class SlowStage {
 public:
  /// The line without its end; what is beyond 200 bytes of it is cut.
  explicit SlowStage(const std::string& line);
  ~SlowStage();
  SlowStage(const SlowStage&) = delete;
  SlowStage& operator=(const SlowStage&) = delete;
};

}  // namespace boule::cli
