#include "render/apps/cli/options/pack_options.h"

#include "render/apps/cli/options/look_options.h"
#include "render/apps/cli/options/option_kinds.h"
#include "render/apps/job/options/option_values.h"
#include "render/apps/job/options/render_choices.h"

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
  add_parsed(app, "--load-limit", command.load_limit, parse_duration,
             "a time above 0 in ms, s, m or h, such as 90s", "TIME",
             "Give up when reading the scene and data files takes longer (no limit)");
  SceneJob& job = command;
  add_rows(app, scene_choices(), job,
           [](const auto& row) { return row.name == "polygons" || row.name == "threads"; });
  add_look_options(app, command.look);
}

}  // namespace boule::cli
