#pragma once

#include "render/cli/exit_code.h"
#include "render/cli/options.h"

namespace boule::cli {

/// Renders a scene file to a picture file.
ExitCode run(const RenderCommand& command);

/// Tells what a scene holds, on standard output.
ExitCode run(const InfoCommand& command);

/// Lists the instruction sets on standard output.
ExitCode run(const IsaCommand& command);

}  // namespace boule::cli
