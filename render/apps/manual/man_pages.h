#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "render/apps/manual/command_facts.h"

namespace boule::manual {

/// Names such as "boule-render.1", and texts in Markdown.
using Pages = std::vector<std::pair<std::string, std::string>>;

/// The manual pages: boule(1), one for each section of docs/command_line.md that is headed by a
/// command, with that command's options, and boule-scene(5), which is docs/scene_format.md. An
/// error names a command that the document does not describe.
Result<Pages> man_pages(const std::vector<CommandFacts>& commands, const std::string& command_line,
                        const std::string& scene_format);

}  // namespace boule::manual
