#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/view/session/pane_stage.h"
#include "render/apps/view/session/scene_source.h"

/// The server's messages as JSON: docs/view_protocol.md.
namespace boule::view {

/// What is in a scene, that of its instances among it, and a sphere around its spheres
/// and capsules.
struct SceneFigures {
  std::size_t spheres = 0, planes = 0, capsules = 0;
  Vec3d center;
  double radius = 1;
};
SceneFigures figures_of(const LoadedScene& loaded);

/// What a state tells.
struct ShownState {
  const Wish& wish;
  const SourceFacts& facts;
  const LoadedScene& loaded;
  const std::vector<NumberRange>& columns;
  const std::vector<std::string>& notes;
  const SceneFigures& figures;
  const Wish& start;  ///< what the scene and the command line ask for
};
std::string state_text(const ShownState& shown);

/// The camera alone, where another client has moved it.
std::string camera_text(std::uint32_t number, const Camera& camera, const Vec3d& origin);

/// How far two panes are apart.
struct DifferenceFigures {
  std::size_t pixels = 0;  ///< that differ
  double largest = 0;      ///< in codes of 255, or floats
};
std::string statistics_text(std::uint32_t number, PaneStage& stage,
                            const std::optional<DifferenceFigures>& difference);

/// What is being done; empty: it is over.
std::string busy_text(const std::string& what);

/// An error about a message of this type, or about the "scene".
std::string error_text(const std::string& about, const Diagnostic& error,
                       std::optional<std::uint32_t> id = {});

std::string saving_text(std::uint32_t id, double share);
std::string saved_text(std::uint32_t id, const std::string& url, const std::string& name);

/// The camera as TOML, and a command line that shows the same; empty: there is none.
std::string texts_text(std::uint32_t id, const std::string& camera, const std::string& command);

}  // namespace boule::view
