// Speed against error: measures, and writes the figures as JSON. publish.py makes a page of them.
//
//   report [--quick] -o report.json
//
// Exit code 1: a robust solver was wrong, or the file could not be written; 2: bad arguments.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "bench/report/figures.h"
#include "bench/tools/command_line.h"

namespace boule::bench {
namespace {

struct Arguments {
  ReportSettings settings;
  std::string file;
};

bool write_file(const std::string& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  if (file << content << std::flush) return true;
  std::fprintf(stderr, "report: cannot write '%s'\n", path.c_str());
  return false;
}

bool robust_is_right(const std::vector<CaseErrors>& cases) {
  for (const CaseErrors& row : cases) {
    const bool ours = row.errors.contender == "robust";
    if (ours && row.errors.figures.wrong_decisions + row.errors.figures.wrong_roots != 0) {
      std::fprintf(stderr, "report: robust is wrong in %s on %s\n", row.hard_case.c_str(),
                   row.isa.c_str());
      return false;
    }
  }
  return true;
}

int run(const Arguments& arguments) {
  const std::string command =
      std::string("report ") + (arguments.settings.quick ? "--quick " : "") + "-o report.json";
  const Figures figures = measure(arguments.settings, command);
  const bool right = robust_is_right(figures.cases) && robust_is_right(figures.capsules);
  return write_file(arguments.file, to_json(figures)) && right ? 0 : 1;
}

void add_options(CLI::App& app, Arguments& arguments) {
  app.add_flag("--quick", arguments.settings.quick, "Under two minutes, smaller samples");
  app.add_option("-o,--output", arguments.file, "The figures, .json")->required();
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  using namespace boule::bench;
  return run_program<Arguments>("Measures speed against error.", argc, argv, add_options, run);
}
