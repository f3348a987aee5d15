#pragma once

#include "core/base/error.h"
#include "render/cli/options.h"

namespace boule::cli {

/// What is wrong with the names of a series: each frame needs files of its own.
Status check_frames(const RenderCommand& command);

/// What is wrong with the names of a single picture: a place for a frame's number in that of the
/// picture or its statistics, or in that of a scene that is not there.
Status check_single(const RenderCommand& command);

/// The latter.
Status check_single_scene(const std::string& scene);

/// The command that renders one frame of a series: the number stands in all names.
RenderCommand command_of_frame(const RenderCommand& command, int frame);

/// What is known to be wrong with the folders of a series' pictures, where their names hold the
/// number: each frame has one of its own then. In others the first frame tells.
Status check_folders(const RenderCommand& command, const FrameRange& frames);

}  // namespace boule::cli
