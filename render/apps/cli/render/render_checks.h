#pragma once

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"
#include "render/apps/job/scene_loader.h"
#include "render/files/scene_file/scene_file.h"
#include "render/renderer/render_options.h"

namespace boule::cli {

/// What `boule render` refuses before it renders. Each error is about one option, or about a file.

/// Errors in the command that show without reading the scene.
Status check_command(const RenderCommand& command);

/// Whether something can be drawn on the picture; and whether the command itself asks for that.
bool can_be_drawn_on(const RenderCommand& command);
bool asks_for_drawing(const RenderCommand& command);

/// Errors with the files to be written. A picture that is there already and may be skipped need not
/// be writable.
Status check_outputs(const RenderCommand& command);

/// An error if the scene cannot have the legend, or the picture would replace one of its files.
Status check_loaded(const RenderCommand& command, const SceneLoader& loader,
                    const LoadedScene& loaded);

/// An error if the picture is to be transparent and its format cannot be.
Status check_transparency(const RenderOptions& options, const RenderCommand& command);

}  // namespace boule::cli
