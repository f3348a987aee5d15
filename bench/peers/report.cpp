#include "bench/peers/report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/peers/frames/text_file.h"

namespace boule::bench {
namespace {

using Json = nlohmann::ordered_json;

const char* clock_name(const RefereeSettings& settings) {
  return settings.threads == 1 ? "thread CPU time" : "wall clock";
}

Json to_json(const Machine& machine) {
  return {{"cpu", machine.cpu},
          {"cores", machine.cores},
          {"compiler", machine.compiler},
          {"flags", machine.flags},
          {"embree", machine.embree}};
}

Json to_json(const RefereeSettings& settings) {
  return {{"repetitions", settings.repetitions},
          {"threads", settings.threads},
          {"clock", clock_name(settings)},
          {"side", settings.side}};
}

Json to_json(const Check& check) {
  return {{"scene", check.scene},
          {"rays", check.rays},
          {"count", check.count},
          {"sampled", check.sampled},
          {"truth_mismatches", check.truth_mismatches},
          {"one_solve_mrays_per_s", check.one_solve}};
}

Json to_json(const std::optional<OracleVerdict>& verdict) {
  if (!verdict) return nullptr;
  return {{"judged", verdict->judged}, {"wrong", verdict->wrong}};
}

Json to_json(const Row& row) {
  return {{"scene", row.scene},
          {"rays", row.rays},
          {"contender", row.contender},
          {"isa", row.isa},
          {"width", row.width},
          {"solver", row.solver},
          {"mrays_per_s", row.median},
          {"min", row.min},
          {"max", row.max},
          {"repetitions", row.repetitions},
          {"ratio_to_best_embree", row.ratio_to_best_embree},
          {"ratio_within_isa", row.ratio_within_isa},
          {"mismatches", row.mismatches},
          {"oracle", to_json(row.oracle)}};
}

template <class T>
Json list(const std::vector<T>& values) {
  Json all = Json::array();
  for (const T& value : values) all.push_back(to_json(value));
  return all;
}

/// "8/8": the oracle found 8 of 8 mismatches wrong.
std::string to_text(const std::optional<OracleVerdict>& verdict) {
  if (!verdict) return "-";
  return std::to_string(verdict->wrong) + "/" + std::to_string(verdict->judged);
}

/// "12 %"
std::string share_of_one_solve(const Row& row, const Check& check) {
  if (!(check.one_solve > 0)) return "-";
  return std::to_string(std::lround(100 * row.median / check.one_solve)) + " %";
}

}  // namespace

void print_machine(const Machine& machine, const RefereeSettings& settings) {
  std::printf("%s, %u cores; %s %s; Embree %s\n", machine.cpu.c_str(), machine.cores,
              machine.compiler.c_str(), machine.flags.c_str(), machine.embree.c_str());
  std::printf("%dx%d pixels, %u thread%s, %s, up to %d repetitions, interleaved\n", settings.side,
              settings.side, settings.threads, settings.threads == 1 ? "" : "s",
              clock_name(settings), settings.repetitions);
  std::fflush(stdout);
}

void print_workload(const Check& check, const std::vector<Row>& rows) {
  std::printf("\n%s %s: %zu rays; truth against brute force: %zu of %zu differ\n",
              check.scene.c_str(), check.rays.c_str(), check.count, check.truth_mismatches,
              check.sampled);
  if (check.one_solve > 0)
    std::printf("one solve a ray, rays read and answers written: %.0f Mray/s\n", check.one_solve);
  std::printf("%-34s %-7s %6s %-7s %8s %17s %4s %6s %7s %10s %s\n", "contender", "isa", "width",
              "solver", "Mray/s", "min..max", "reps", "ratio", "in isa", "mismatches",
              "oracle: wrong; of one solve");
  for (const Row& row : rows) {
    std::printf("%-34s %-7s %6zu %-7s %8.3f %8.3f..%7.3f %4d %6.2f %7.2f %10zu %s; %s\n",
                row.contender.c_str(), row.isa.c_str(), row.width, row.solver.c_str(), row.median,
                row.min, row.max, row.repetitions, row.ratio_to_best_embree, row.ratio_within_isa,
                row.mismatches, to_text(row.oracle).c_str(),
                share_of_one_solve(row, check).c_str());
  }
  std::fflush(stdout);
}

Status write_json(const std::string& path, const Machine& machine, const RefereeSettings& settings,
                  const Results& results) {
  const Json report = {{"machine", to_json(machine)},
                       {"settings", to_json(settings)},
                       {"checks", list(results.checks)},
                       {"rows", list(results.rows)}};
  return write_text(path, report.dump(2) + '\n');
}

}  // namespace boule::bench
