#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "bench/report/commit.h"
#include "bench/report/figures.h"
#include "bench/tools/cpu_model.h"
#include "render/files/scene_file/scene_file.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

/// "2026-11-22", or empty where SOURCE_DATE_EPOCH is not whole seconds.
std::string source_date() {
  const char* const variable = std::getenv("SOURCE_DATE_EPOCH");
  if (variable == nullptr || *variable == '\0') return "";
  char* end = nullptr;
  const std::time_t seconds = std::strtoll(variable, &end, 10);
  std::tm date{};
  char text[32];
  if (*end != '\0' || gmtime_r(&seconds, &date) == nullptr) return "";
  return std::strftime(text, sizeof text, "%Y-%m-%d", &date) == 0 ? "" : text;
}

Provenance find_provenance(const std::string& command) {
  return {cpu_model(),
          std::thread::hardware_concurrency(),
          compiler,
          BOULE_BENCH_FLAGS,
          commit_of_build(),
          source_date(),
          command};
}

std::vector<CaseErrors> measure_cases(std::size_t rays) {
  std::vector<CaseErrors> cases;
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    for (const test::HardCaseSpec& spec : sphere_cases()) {
      for (HardErrors& errors : hard_errors(spec, rays, info.isa))
        cases.push_back({name_of(spec), std::string(info.name), std::move(errors)});
    }
  }
  return cases;
}

std::vector<CaseErrors> measure_capsules(std::size_t rays, const std::string& isa) {
  std::vector<CaseErrors> cases;
  for (const test::CapsuleCaseSpec& spec : test::capsule_case_specs()) {
    for (HardErrors& errors : capsule_errors(spec, rays))
      cases.push_back({name_of(spec), isa, std::move(errors)});
  }
  return cases;
}

/// Measures scenes of this source tree. A scene that cannot be loaded is reported and left out.
std::vector<ScenePathErrors> measure_paths(int reference) {
  std::vector<ScenePathErrors> all;
  for (const char* name : {"soft_light", "daylight"}) {
    const auto scene = load_path_scene(std::string(BOULE_SCENES "/") + name + ".toml");
    if (!scene) {
      std::fprintf(stderr, "report: %s\n", format_diagnostic(scene.error()).c_str());
      continue;
    }
    const KernelTable& kernels = *select_kernels("auto").value();
    all.push_back({name, measure_path_errors(scene.value(), kernels, reference)});
  }
  return all;
}

/// The same for noise to order.
std::vector<SceneNoiseErrors> measure_noise(bool quick) {
  std::vector<SceneNoiseErrors> all;
  for (const char* name : {"spheres_on_plane", "first_light", "soft_light"}) {
    const auto loaded = load_scene(std::string(BOULE_SCENES "/") + name + ".toml");
    if (!loaded) {
      std::fprintf(stderr, "report: %s\n", format_diagnostic(loaded.error()).c_str());
      continue;
    }
    NoiseSettings settings;
    if (quick) settings = {.width = 64, .height = 36, .reference = 512};
    settings.threads = 0;
    all.push_back({name, measure_noise_errors(loaded.value().scene, settings)});
  }
  return all;
}

void say(const char* what) { std::fprintf(stderr, "report: %s\n", what); }

}  // namespace

Figures measure(const ReportSettings& settings, const std::string& command) {
  const bool quick = settings.quick;
  Figures figures;
  figures.settings = settings;
  figures.provenance = find_provenance(command);
  const Isa widest = select_kernels("auto").value()->isa;
  figures.widest = isa_name(widest);
  say("speeds");
  const std::vector<std::string> few = {"u1000", "u10000"};
  const std::vector<std::string> all = {"u1000", "u10000", "u100000", "flake4"};
  figures.speeds = measure_solver_speeds(quick ? few : all, quick ? 5 : 15, quick ? 256 : 512);
  say("hard cases");
  figures.cases = measure_cases(quick ? 500 : 5000);
  figures.capsules = measure_capsules(quick ? 500 : 5000, figures.widest);
  say("distance and grazing");
  figures.map = map_errors(quick ? 100 : 1000, widest);
  say("epsilons");
  figures.epsilons = run_epsilon_experiment(quick ? 1000 : 5000, settings.seed);
  figures.pictures = draw_epsilon_pictures(scene_on_ground(1e4), 320, 240);
  say("growth");
  figures.growth = measure_growth(quick ? 5 : 6, quick ? 256 : 512, quick ? 3 : 7);
  say("path tracing");
  figures.paths = measure_paths(quick ? 512 : 8192);
  say("noise to order");
  figures.noise = measure_noise(quick);
  say("Embree");
  figures.peers = measure_peers(quick);
  return figures;
}

}  // namespace boule::bench
