#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/manual/command_facts.h"

namespace boule::manual {

/// What the pages are made of besides the commands.
struct ManualSources {
  std::string version;       ///< "1.0.0"
  std::string date;          ///< "2026-11-24"
  std::string command_line;  ///< docs/command_line.md
  std::string scene_format;  ///< docs/scene_format.md
};

struct ManualFile {
  std::string name;  ///< "boule-render.1"
  std::string text;
};

/// The manual pages, as roff with the macros man(7): boule(1), one for each section of
/// docs/command_line.md that is headed by a command, with that command's options, and
/// boule-scene(5). An error names a command that the document does not describe.
Result<std::vector<ManualFile>> man_pages(const std::vector<CommandFacts>& commands,
                                          const ManualSources& sources);

}  // namespace boule::manual
