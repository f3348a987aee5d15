#pragma once

#include "render/apps/cli/options/options.h"
#include "render/apps/cli/process/exit_code.h"

namespace boule::cli {

/// Renders a scene file to a picture file.
ExitCode run(const RenderCommand& command);

/// Shows a scene in a browser, until it is interrupted.
ExitCode run(const ViewCommand& command);

/// Makes a picture of film files.
ExitCode run(const MergeCommand& command);

/// Packs a scene into a file that is mapped.
ExitCode run(const PackCommand& command);

/// Writes the scene that shows a particle file to standard output.
ExitCode run(const SceneCommand& command);

/// Traces the rays of a file against a scene, to a file of hits.
ExitCode run(const TraceCommand& command);

/// Tells what a scene holds, on standard output.
ExitCode run(const InfoCommand& command);

/// Lists the instruction sets on standard output.
ExitCode run(const IsaCommand& command);

}  // namespace boule::cli
