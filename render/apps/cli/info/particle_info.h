#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/apps/job/particle_look.h"

namespace boule::cli {

/// Describes one frame of a particle file: format, frames, species with their counts, the range of
/// each column, cell, box, and under "picture" what `boule render` would choose. `frame` is the
/// number of a frame of a series. Errors as load_particle_scene().
Result<nlohmann::ordered_json> particle_info(const std::string& path, const LookOptions& look,
                                             std::optional<int> frame);

}  // namespace boule::cli
