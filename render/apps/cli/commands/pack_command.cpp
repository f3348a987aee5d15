#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/instances.h"
#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/reading_limit.h"
#include "render/apps/cli/report/output_check.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/job/options/option_values.h"
#include "render/apps/job/particle_scene.h"
#include "render/apps/job/scene_loader.h"
#include "render/files/packed/pack.h"
#include "render/files/packed/packed_file.h"
#include "render/files/scene_file/loaded/scene_origin.h"
#include "render/files/scene_file/npy/npy_source.h"
#include "render/frame/scheduler.h"
#include "render/memory/available_memory.h"

namespace boule::cli {
namespace {

/// "12.3 KiB" or, from 1 MiB on, "1.5 MiB".
std::string size_text(std::uint64_t bytes) {
  const auto kib = static_cast<double>(bytes) / 1024;
  return kib < 1024 ? fmt::format("{:.1f} KiB", kib) : fmt::format("{:.1f} MiB", kib / 1024);
}

/// A scene without its spheres, and where these come from.
struct Input {
  std::unique_ptr<SceneLoader> loader{};  ///< what the source of particles runs its loops by
  Scene scene{};
  Vec3d origin{};
  std::shared_ptr<SphereSource> spheres{};
};

/// Errors in the command that show without reading any file.
Status check(const PackCommand& command) {
  if (!is_packed_name(command.output)) {
    return wrong_option(
        "a packed scene is written, which is not the extension of " + quote(command.output),
        "--output");
  }
  RunOptions outputs;
  outputs.output = command.output;
  return check_data_files(outputs, "packed scene", command.inputs);
}

/// Whether an input is spheres alone, which need not fit into memory.
bool is_spheres(const std::string& input, const LookOptions& look) {
  if (input == "-") return true;
  return input.ends_with(".npy") && !is_particle_input(input, look);
}

void tell(const PackCommand& command, const std::vector<std::string>& notes) {
  if (command.quiet) return;
  for (const std::string& note : notes) print_note("boule: note: " + printable(note));
}

Result<Input> spheres_alone(const PackCommand& command, const ParallelFor& parallel_for) {
  auto source = NpySource::open(command.inputs, command.output, parallel_for);
  if (!source) return source.error();
  const auto extent = source.value()->extent();
  if (!extent) return extent.error();
  std::vector<std::string> notes;
  Input input;
  input.scene.materials.push_back({"default", Matte{}});
  input.origin = choose_origin({extent.value()}, {}, notes);
  source.value()->set_origin(input.origin);
  tell(command, notes);
  input.spheres = std::move(source).value();
  return Result<Input>(std::move(input));
}

/// A scene that is read as a whole, but for particles that are all its spheres and can be read part
/// by part.
Result<Input> whole_scene(const PackCommand& command) {
  RenderJob reading{command};
  reading.scene = command.inputs.front();
  Input input;
  input.loader = std::make_unique<SceneLoader>(reading);
  input.loader->let_stream();
  ReadingLimit limit(command.load_limit);
  const ReadingLimit::Reading guard(limit, reading.scene);
  auto loaded = input.loader->load(std::nullopt);
  if (!loaded) return loaded.error();
  if (!command.quiet) {
    for (const std::string& warning : loaded.value().warnings) print_note(warning);
  }
  tell(command, loaded.value().notes);
  input.scene = std::move(loaded.value().scene);
  input.origin = loaded.value().origin;
  if (input.scene.packed)
    return Diagnostic::in_file(reading.scene, "its spheres are packed already");
  input.spheres = std::move(loaded.value().source);
  if (input.spheres) return Result<Input>(std::move(input));
  if (may_have_ghosts(input.scene))
    return Diagnostic::in_file(reading.scene, "packed scenes have no ghosts");
  expand_instances(input.scene);
  input.spheres = std::make_shared<SpheresInMemory>(std::exchange(input.scene.spheres, {}));
  return Result<Input>(std::move(input));
}

Result<Input> open_input(const PackCommand& command, const ParallelFor& parallel_for) {
  const std::vector<std::string>& inputs = command.inputs;
  const auto alone = [&](const std::string& input) { return is_spheres(input, command.look); };
  const bool from_pipe = std::find(inputs.begin(), inputs.end(), "-") != inputs.end();
  if (inputs.size() == 1 && !alone(inputs.front())) return whole_scene(command);
  if (inputs.size() > 1 && (from_pipe || !std::all_of(inputs.begin(), inputs.end(), alone))) {
    return Diagnostic::about("INPUT",
                             "more than one are packed only where all are .npy files of "
                             "spheres alone");
  }
  return spheres_alone(command, parallel_for);
}

ExitCode write(const PackCommand& command, Input input, const ParallelFor& parallel_for) {
  const PackMeans means{
      .memory = command.memory.value_or(std::clamp<std::uint64_t>(
          available_memory() / 2, std::uint64_t{16} << 20, std::uint64_t{1} << 40)),
      .beside = {},
      .parallel_for = parallel_for,
      .stop = [] { return WriteGuard::interrupted(); }};
  const Result<PackResult> packed = write_guarded(
      [&] {
        return pack({std::move(input.scene), input.origin, *input.spheres, command.output, means});
      },
      "the packed scene had been written");
  if (!packed) return report(packed.error(), packed.error().file.empty() ? failed : invalid_input);
  if (!command.quiet) {
    const PackResult& result = packed.value();
    print_note(fmt::format("boule: {}: {}, {}{}", command.output,
                           counted(static_cast<std::size_t>(result.spheres), "sphere"),
                           size_text(result.bytes),
                           result.chunks > 1 ? fmt::format(", {} chunks", result.chunks) : ""));
  }
  return done;
}

}  // namespace

ExitCode run(const PackCommand& command) {
  if (auto done = check(command); !done) return report(done.error(), wrong_usage);
  if (auto done = check_output(command.output); !done) return report(done.error(), failed);
  Scheduler scheduler(command.threads);
  const ParallelFor parallel_for = scheduler.parallel_for();
  auto input = open_input(command, parallel_for);
  if (!input) {
    const bool usage = input.error().key == "INPUT";
    return report(input.error(), usage ? wrong_usage : code_of_loading(input.error()));
  }
  return write(command, std::move(input).value(), parallel_for);
}

}  // namespace boule::cli
