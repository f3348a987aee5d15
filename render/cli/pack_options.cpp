#include "render/cli/pack_options.h"

#include <array>

#include "render/cli/look_options.h"
#include "render/cli/option_kinds.h"
#include "render/cli/option_values.h"

namespace boule::cli {

void add_pack(CLI::App& app, PackCommand& command) {
  app.add_option("INPUT", command.inputs,
                 "Scene, particles, or spheres alone, N x 4: .npy files, one after the other, or - "
                 "for a .npy on standard input")
      ->required()
      ->type_name("");
  start_group(app, "Output");
  app.add_option("-o,--output", command.output, "Packed scene to write, .boule")
      ->required()
      ->type_name("SCENE.boule");
  app.add_flag("-q,--quiet", command.quiet, "No notes and warnings, only errors");
  start_group(app, "Work");
  add_parsed(app, "--memory", command.memory, parse_bytes,
             "a size of 16M or more, such as 500M or 8G", "SIZE",
             "Memory to build in; spheres that do not fit go through temporary files beside the "
             "output (half of the memory there is)");
  add_whole(app, "-t,--threads", command.threads, 0U, 1024U, "Threads, 0: all (0)");
  add_parsed(app, "--load-limit", command.load_limit, parse_duration,
             "a time above 0 in ms, s, m or h, such as 90s", "TIME",
             "Give up when reading the scene and data files takes longer (no limit)");
  add_choice(app, "--polygons", command.polygons,
             std::array{Choice{"plane", PolygonPolicy::plane}, Choice{"skip", PolygonPolicy::skip},
                        Choice{"error", PolygonPolicy::error}},
             "What an NFF polygon becomes (plane)");
  add_look_options(app, command.look);
}

}  // namespace boule::cli
