// Speed against error: measures, and writes one page that shows it.
//
//   report [--quick] -o report.html [--chart chart.svg] [--path-chart chart.svg]
//          [--readme README.md]
//
// Beside the page come its figures, report.json. A README gets its table anew. Exit code 1: a
// robust solver was wrong, or a file could not be written; 2: bad arguments.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "bench/command_line.h"
#include "bench/report/figures.h"

namespace boule::bench {
namespace {

struct Arguments {
  ReportSettings settings;
  std::string page, chart, path_chart, readme;
};

/// All or nothing: under another name first.
bool write_file(const std::filesystem::path& path, const std::string& content) {
  const std::filesystem::path temporary = path.string() + ".temp";
  std::ofstream file(temporary, std::ios::binary);
  file << content;
  file.close();
  std::error_code failed;
  if (file) std::filesystem::rename(temporary, path, failed);
  if (file && !failed) return true;
  std::filesystem::remove(temporary, failed);
  std::fprintf(stderr, "report: cannot write '%s'\n", path.c_str());
  return false;
}

bool update_readme(const std::string& path, const Figures& figures) {
  std::ifstream file(path, std::ios::binary);
  const std::string old{std::istreambuf_iterator<char>(file), {}};
  const std::optional<std::string> updated = with_table(old, figures);
  if (updated) return write_file(path, *updated);
  std::fprintf(stderr, "report: '%s' has no marks for a table\n", path.c_str());
  return false;
}

bool robust_is_right(const Figures& figures) {
  for (const CaseErrors& row : figures.cases) {
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
  const std::filesystem::path page = arguments.page;
  const std::string command =
      std::string("report ") + (arguments.settings.quick ? "--quick " : "") + "-o report.html";
  Figures figures = measure(arguments.settings, command);
  std::filesystem::path json = page;
  json.replace_extension(".json");
  bool written = write_file(json, to_json(figures)) && write_file(page, to_html(figures));
  if (!arguments.chart.empty())
    written = written && write_file(arguments.chart, main_chart(figures));
  if (!arguments.path_chart.empty())
    written = written && write_file(arguments.path_chart, path_chart(figures));
  if (!arguments.readme.empty()) written = written && update_readme(arguments.readme, figures);
  return written && robust_is_right(figures) ? 0 : 1;
}

void add_options(CLI::App& app, Arguments& arguments) {
  app.add_flag("--quick", arguments.settings.quick, "Under two minutes, smaller samples");
  app.add_option("-o,--output", arguments.page, "The page, .html; figures go beside it, .json")
      ->required();
  app.add_option("--chart", arguments.chart, "The first chart by itself, .svg");
  app.add_option("--path-chart", arguments.path_chart, "That of path tracing by itself, .svg");
  app.add_option("--readme", arguments.readme, "A text whose table is brought up to date")
      ->check(CLI::ExistingFile);
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  using namespace boule::bench;
  return run_program<Arguments>("Measures speed against error and writes one page about it.", argc,
                                argv, add_options, run);
}
