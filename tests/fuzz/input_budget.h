#pragma once

#include <ctime>

#include "tests/fuzz/require.h"

namespace boule::fuzz {

/// While it lives an input is tried: within five seconds of the processor, which a machine's load
/// does not change. (The limit of libFuzzer's own is on the time that passes: it ends what hangs.)
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
