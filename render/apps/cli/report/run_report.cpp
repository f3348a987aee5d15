#include "render/apps/cli/report/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <type_traits>

#include "core/scene/instances.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/report/picture_stream.h"
#include "simd/dispatch/dispatch.h"

namespace boule::cli {

namespace {

/// Whether two names lead to one file, existing or not.
bool is_one_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored))
    return std::filesystem::is_regular_file(a, ignored);
  const auto real_a = std::filesystem::weakly_canonical(a, ignored);
  return a == b || (!real_a.empty() && real_a == std::filesystem::weakly_canonical(b, ignored));
}

}  // namespace

Status check_run(const SceneJob& job, const RunOptions& options, const std::string& output,
                 const std::vector<std::string>& inputs) {
  const std::string& stats = options.stats.file;
  if (is_one_file(stats, options.output)) {
    return wrong_option("statistics would replace the " + output + ", expected another file",
                        "--stats");
  }
  if (auto done = check_data_files(options, output, inputs); !done) return done;
  const auto kernels = select_kernels(job.isa);
  if (!kernels) return kernels.error();
  return {};
}

bool is_stream(const std::string& output) {
  std::error_code ignored;
  return output == standard_output || (std::filesystem::exists(output, ignored) &&
                                       !std::filesystem::is_regular_file(output, ignored));
}

Status check_data_files(const RunOptions& options, const std::string& output,
                        const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const std::string would = " would replace " + quote(file) + ", expected another file";
    if (is_one_file(options.output, file)) return wrong_option("the " + output + would, "--output");
    if (is_one_file(options.stats.file, file)) return wrong_option("statistics" + would, "--stats");
  }
  return {};
}

void tell_sending(const std::string& output) {
  if (is_stream(output)) set_written("the output is incomplete");
}

void RunReport::note(const std::string& text) const {
  if (options_.verbosity != Verbosity::quiet) print_note(text);
}

void RunReport::note_once(const std::string& text) const {
  if (options_.verbosity != Verbosity::quiet) live_.tell_once(text, job_.scene);
}

void RunReport::detail(const std::string& text) const {
  if (options_.verbosity == Verbosity::verbose) print_note("boule: note: " + text);
}

void RunReport::loaded(const LoadedScene& loaded, double seconds) const {
  for (const std::string& warning : loaded.warnings) note_once(warning);
  for (const std::string& note : loaded.notes) note_once("boule: note: " + printable(note));
  const Scene& scene = loaded.scene;
  const PrimitiveCount count = count_primitives(scene);
  // Where particles are there and none is selected, that is told already.
  const bool has_particles =
      std::any_of(loaded.particles.begin(), loaded.particles.end(),
                  [](const ParticleFacts& facts) { return facts.particles > 0; });
  if (count.total() == 0 && !has_particles)
    note_once("boule: note: no objects in the scene: nothing to be hit");
  std::string objects;
  each_kind([&](auto kind) {
    using Primitive = typename decltype(kind)::Primitive;
    if (std::is_same_v<Primitive, Capsule> && count.capsules == 0) return;
    objects += counted(kind.of(count), kind.name) + ", ";
  });
  detail(fmt::format("{}: {}{}, {}, read in {:.3f} s", job_.scene, objects,
                     counted(scene.lights.size(), "light"),
                     counted(scene.materials.size(), "material"), seconds));
}

void RunReport::prepared(const RunStatistics& run) const {
  detail(fmt::format("prepared in {:.3f} s for {} ({}), solver {}", run.prepare_seconds, run.isa,
                     counted(static_cast<std::size_t>(run.width), "lane"), name_of(run.solver)));
}

ExitCode RunReport::finish(const Stats& stats) const {
  const Status status = write_guarded([&] { return write_stats(stats, options_.stats); });
  return status ? done : report(status.error(), failed);
}

}  // namespace boule::cli
