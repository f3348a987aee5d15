#pragma once

#include <ctime>

#include "tests/fuzz/require.h"

namespace boule::fuzz {

/// Limits an input to five seconds of processor time for as long as this lives; load does not
/// change that. (libFuzzer's own limit is on wall-clock time: it ends inputs that hang.)
class InputBudget {
 public:
  InputBudget() = default;
  InputBudget(const InputBudget&) = delete;
  InputBudget& operator=(const InputBudget&) = delete;
  ~InputBudget() {
    require(std::clock() - begin_ < 5 * CLOCKS_PER_SEC, "an input takes little time");
  }

 private:
  std::clock_t begin_ = std::clock();
};

}  // namespace boule::fuzz
