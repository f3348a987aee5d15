#include "bench/peers/frames/frame_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/peers/frames/frame_programs.h"
#include "bench/peers/frames/text_file.h"

namespace boule::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

Json to_json(const FrameRow& row) {
  Json json = {{"scene", row.scene}, {"program", row.program}};
  if (!row.missing.empty()) {
    json["missing"] = row.missing;
    return json;
  }
  json["cpu_s"] = to_json(row.cpu);
  json["start_up_cpu_s"] = row.start_up;
  json["ratio_to_boule"] = row.ratio;
  if (!row.difference) return json;
  json["difference"] = {{"mean", row.difference->mean},
                        {"share", row.difference->share},
                        {"mean_allowed", row.tolerance->mean},
                        {"share_allowed", row.tolerance->share},
                        {"alike", row.alike()}};
  return json;
}

Json to_json(const ScalingRow& row) {
  return {{"scene", row.scene},
          {"program", row.program},
          {"wall_s_1_thread", to_json(row.one)},
          {"wall_s_2_threads", to_json(row.two)},
          {"speedup", row.speedup}};
}

template <class T>
Json list(const std::vector<T>& values) {
  Json all = Json::array();
  for (const T& value : values) all.push_back(to_json(value));
  return all;
}

void print_row(const FrameRow& row) {
  if (!row.missing.empty()) {
    std::printf("%-16s not installed: no program %s\n", row.program.c_str(), row.missing.c_str());
    return;
  }
  std::printf("%-16s %8.3f %8.3f..%7.3f %8.3f %7.2f", row.program.c_str(), row.cpu.median,
              row.cpu.min, row.cpu.max, row.start_up, row.ratio);
  if (row.difference) {
    std::printf("  %.4f of %.4f, %.2f of %.2f %%: %s", row.difference->mean, row.tolerance->mean,
                100 * row.difference->share, 100 * row.tolerance->share,
                row.alike() ? "alike" : "NOT THE SAME PICTURE");
  }
  std::printf("\n");
}

}  // namespace

void print_frame_machine(const Machine& machine, const FrameSettings& settings) {
  std::printf("%s, %u cores; %s %s\n", machine.cpu.c_str(), machine.cores, machine.compiler.c_str(),
              machine.flags.c_str());
  std::printf(
      "%dx%d pixels, %d bounce, CPU time of one thread less that of 8x8 pixels, %d repetitions, "
      "interleaved\n",
      settings.side, settings.side, frame_bounces, settings.repetitions);
  std::fflush(stdout);
}

void print_frames(const FrameResults& results) {
  std::printf("\n%s\n%-16s %8s %17s %8s %7s  %s\n", results.rows.front().scene.c_str(), "program",
              "CPU s", "min..max", "start-up", "ratio",
              "picture: mean difference, pixels that differ by more than 0.1");
  for (const FrameRow& row : results.rows) print_row(row);
  for (const ScalingRow& row : results.scaling) {
    std::printf("%-16s on the wall: 1 thread %.3f s, 2 threads %.3f s, speed-up %.2f\n",
                row.program.c_str(), row.one.median, row.two.median, row.speedup);
  }
  std::fflush(stdout);
}

Status write_frames_json(const std::string& path, const Machine& machine,
                         const FrameSettings& settings, const FrameResults& results) {
  const Json report = {{"machine",
                        {{"cpu", machine.cpu},
                         {"cores", machine.cores},
                         {"compiler", machine.compiler},
                         {"flags", machine.flags}}},
                       {"settings",
                        {{"repetitions", settings.repetitions},
                         {"side", settings.side},
                         {"bounces", frame_bounces},
                         {"clock", "CPU time of the process, less that of 8x8 pixels"}}},
                       {"frames", list(results.rows)},
                       {"scaling", list(results.scaling)}};
  return write_text(path, report.dump(2) + '\n');
}

}  // namespace boule::bench
