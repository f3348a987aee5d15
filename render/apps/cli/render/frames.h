#pragma once

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"

namespace boule::cli {

/// An error in the names of a series: each frame needs files of its own.
Status check_frames(const RenderCommand& command);

/// An error in the names of a single picture: the name of the picture, of its statistics, or of a
/// scene that is not there has a slot for a frame's number.
Status check_single(const RenderCommand& command);

/// check_single() for the name of the scene alone.
Status check_single_scene(const std::string& scene);

/// The command that renders one frame of a series, with the frame's number in all names.
RenderCommand command_of_frame(const RenderCommand& command, int frame);

/// Checks, before the first frame, the folders of a series whose folder names hold the frame's
/// number: each frame has one of its own. Other folders are checked with the first frame.
Status check_folders(const RenderCommand& command, const FrameRange& frames);

}  // namespace boule::cli
