// The lecture's remedies against false shadows and ours, where they fail: the share of points that
// are wrongly dark or wrongly lit, over the scale of the scene, the distance of the camera and the
// radius of the ground. The truth is a tracer in long double.
//
//   bench_epsilons [points per figure, 20000] [--pictures DIR]
//
// With --pictures also EXPERIMENT-X-REMEDY.png of a few scenes, and ...-marked.png with false
// shadows in red and leaks of light in blue.
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "bench/errors/epsilons.h"
#include "render/image/write_image.h"

namespace boule::bench {
namespace {

struct Arguments {
  unsigned long points = 20'000;
  std::string pictures;
};

std::optional<Arguments> read(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string text = argv[i];
    if (text == "--pictures") {
      if (++i == argc) return std::nullopt;
      arguments.pictures = argv[i];
    } else {
      char* end = nullptr;
      arguments.points = std::strtoul(text.c_str(), &end, 10);
      if (text[0] == '-' || arguments.points == 0 || *end != '\0') return std::nullopt;
    }
  }
  return arguments;
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// The share in percent. A share of exactly 0 is written differently from one that rounds to 0.
std::string cell(std::size_t wrong, std::size_t points) {
  const double share = percent(wrong, points);
  if (wrong == 0) return "0";
  if (share < 0.005) return "<0.01";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", share);
  return text;
}

/// A row for each scene, a column for each remedy.
void print_table(const char* title, std::size_t EpsilonFigure::*wrong,
                 const std::vector<EpsilonFigure>& figures) {
  const auto remedies = epsilon_remedies();
  std::printf("%s, %% of the points\n%-17s %7s %9s %5s", title, "", "points", "undecided", "lit");
  for (const std::string& remedy : remedies) std::printf(" %13s", remedy.c_str());
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const EpsilonFigure& f = figures[i];
    if (i % remedies.size() == 0) {
      std::printf("\n%-8s %8.3g %7zu %9zu %5.1f", f.experiment.c_str(), f.x, f.points,
                  f.undecided + f.wrong_hits, percent(f.lit, f.points));
    }
    std::printf(" %13s", cell(f.*wrong, f.points).c_str());
  }
  std::printf("\n\n");
}

void print_figures(std::size_t points) {
  constexpr std::uint64_t seed = 1;
  const auto figures = run_epsilon_experiment(points, seed);
  print_table("False shadows", &EpsilonFigure::false_shadows, figures);
  print_table("Leaks of light", &EpsilonFigure::leaks, figures);
}

/// What a file may be called: "t > 1e-6" is t-1e-6.
std::string file_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.';
    if (plain) name += c;
    if (!plain && !name.empty() && name.back() != '-') name += '-';
  }
  return name;
}

bool write(const Image& image, const std::filesystem::path& path) {
  const Status done = write_image(image, path.string());
  if (!done) std::fprintf(stderr, "%s\n", format_diagnostic(done.error()).c_str());
  return done.ok();
}

bool write_pictures(const EpsilonScene& scene, const std::filesystem::path& folder) {
  char x[32];
  std::snprintf(x, sizeof x, "%g", scene.x);
  for (const EpsilonPicture& picture : draw_epsilon_pictures(scene, 640, 480)) {
    const std::string stem = file_name(scene.experiment + "-" + x + "-" + picture.remedy);
    if (!write(picture.plain, folder / (stem + ".png"))) return false;
    if (!write(picture.marked, folder / (stem + "-marked.png"))) return false;
    std::printf("%-45s %8zu false shadows, %8zu leaks, in pixels\n", (stem + ".png").c_str(),
                picture.false_shadows, picture.leaks);
  }
  return true;
}

bool write_pictures(const std::filesystem::path& folder) {
  std::error_code problem;  // ignored: writing the picture reports it better
  std::filesystem::create_directories(folder, problem);
  for (const EpsilonScene& scene : {scene_of_scale(1), scene_of_scale(1e-3), scene_of_scale(1e3),
                                    scene_at_distance(1e4), scene_on_ground(1e4)}) {
    if (!write_pictures(scene, folder)) return false;
  }
  return true;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  const auto arguments = boule::bench::read(argc, argv);
  if (!arguments) {
    std::fprintf(stderr, "usage: bench_epsilons [points per figure, 20000] [--pictures DIR]\n");
    return 2;
  }
  boule::bench::print_figures(arguments->points);
  if (arguments->pictures.empty()) return 0;
  return boule::bench::write_pictures(arguments->pictures) ? 0 : 1;
}
