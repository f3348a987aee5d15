#pragma once

#include "core/base/error.h"
#include "render/cli/options.h"

namespace boule::cli {

/// What is wrong with the names of a series: each frame needs files of its own.
Status check_frames(const RenderCommand& command);

/// The command that renders one frame of a series: the number stands in all names.
RenderCommand command_of_frame(const RenderCommand& command, int frame);

}  // namespace boule::cli
