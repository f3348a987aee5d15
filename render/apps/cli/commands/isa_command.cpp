#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/process/messages.h"
#include "simd/dispatch/dispatch.h"

namespace boule::cli {
namespace {

std::string as_json(const std::vector<IsaInfo>& isas, Isa selected) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const IsaInfo& info : isas) {
    list.push_back({{"name", info.name},
                    {"width", info.width},
                    {"supported", info.supported},
                    {"selected", info.isa == selected}});
  }
  return list.dump(2) + "\n";
}

std::string as_table(const std::vector<IsaInfo>& isas, Isa selected) {
  std::string table = "name     lanes\n";
  for (const IsaInfo& info : isas) {
    const char* remark = info.isa == selected ? "  selected"
                         : info.supported     ? ""
                                              : "  not supported by this CPU";
    table += fmt::format("{:<8} {:>5}{}\n", info.name, info.width, remark);
  }
  return table;
}

}  // namespace

ExitCode run(const IsaCommand& command) {
  const auto kernels = select_kernels("auto");
  if (!kernels) return report(kernels.error(), wrong_usage);
  const Isa selected = kernels.value()->isa;
  const std::vector<IsaInfo> isas = list_isas();
  return print_as_result(command.json ? as_json(isas, selected) : as_table(isas, selected));
}

}  // namespace boule::cli
