// Command lines of any bytes: each line is an argument.
#include <cmath>
#include <string>
#include <vector>

#include "render/apps/cli/options/options.h"
#include "tests/fuzz/input_budget.h"
#include "tests/fuzz/require.h"

namespace {

using namespace boule;
using namespace boule::cli;
using boule::fuzz::require;

/// Checks that parsed options are within the limits that they promise.
struct Promises {
  void operator()(const RenderCommand& command) const {
    if (command.size)
      require(command.size->width >= 1 && command.size->width <= 65535 &&
                  command.size->height >= 1 && command.size->height <= 65535,
              "--size is 1 to 65535 a side");
    if (command.spp) require(*command.spp >= 1, "--spp is 1 at least");
    if (command.max_depth) require(*command.max_depth >= 0, "--max-depth is not negative");
    if (const auto& crop = command.crop)
      require(0 <= crop->x0 && crop->x0 < crop->x1 && 0 <= crop->y0 && crop->y0 < crop->y1,
              "--crop is not empty");
    if (command.time_limit) require(*command.time_limit > 0, "--time-limit is above 0");
    require(command.tile >= 0, "--tile is not negative");
    require(std::isfinite(command.exposure_stops), "--exposure is a number");
  }
  void operator()(const TextCommand& text) const { require(!text.text.empty(), "there is help"); }
  void operator()(const UsageError& error) const {
    require(!error.text.empty(), "a usage error says what is wrong");
    for (const char c : error.text) {
      const auto byte = static_cast<unsigned char>(c);
      require(c == '\n' || (byte >= 0x20 && byte != 0x7f), "no control bytes: " + error.text);
    }
  }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const boule::fuzz::InputBudget budget;
  std::vector<std::string> words{"boule"};
  std::string word;
  for (std::size_t i = 0; i < size; ++i) {
    if (data[i] != '\n' && data[i] != 0) {
      word += static_cast<char>(data[i]);
      continue;
    }
    words.push_back(word);
    word.clear();
  }
  if (!word.empty()) words.push_back(word);
  std::vector<const char*> arguments;
  for (const std::string& each : words) arguments.push_back(each.c_str());
  std::visit(Promises{}, parse_command_line(static_cast<int>(arguments.size()), arguments.data()));
  return 0;
}
