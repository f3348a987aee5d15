#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/renderer/render_options.h"

namespace boule {

/// What the pixels of a run depend on, as names and values: parts of one picture have the same.
using RunFacts = std::vector<std::pair<std::string, std::string>>;

/// The facts of a run: program version, hash of the scene, and the options that pixels depend on,
/// named like those of the command line. Order, tiles, threads and instruction set are not in it.
RunFacts facts_of(const RenderOptions& options, std::uint64_t scene_hash,
                  const std::string& version);

/// The fact in which a film that goes on may differ (Checkpoint::load()).
inline constexpr std::string_view samples_name = "spp";

/// The first difference in words for somebody who has `wanted`: "is of another scene: ...", "has
/// --spp 4, not 16"; empty if there is none. The fact named `but` may differ. Takes any facts.
std::string find_difference(const RunFacts& found, const RunFacts& wanted,
                            std::string_view but = {});

}  // namespace boule
