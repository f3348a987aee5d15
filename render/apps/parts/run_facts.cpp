#include "render/apps/parts/run_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/base/error.h"
#include "core/scene/names.h"
#include "core/scene/scene.h"

namespace boule {
namespace {

constexpr const char* version_name = "version";
constexpr const char* scene_name = "scene";

std::string rect_text(const PixelRect& rect) {
  return fmt::format("{},{},{},{}", rect.x0, rect.y0, rect.x1, rect.y1);
}

std::string aov_text(const AovSelection& aovs) {
  std::string text;
  for (const AovName& aov : aov_names) {
    if (aovs.*aov.wanted) text += (text.empty() ? "" : ",") + std::string(aov.name);
  }
  return text.empty() ? "none" : text;
}

std::string in_words(const std::string& name, const std::string& found, const std::string& wanted) {
  const std::string there = printable(found, 100);
  if (name == version_name) return "was written by boule " + there + ", this is boule " + wanted;
  if (name == scene_name) return "is of another scene: hash " + there + ", not " + wanted;
  return "has --" + name + " " + there + ", not " + wanted;
}

}  // namespace

RunFacts facts_of(const RenderOptions& options, std::uint64_t scene_hash,
                  const std::string& version) {
  RunFacts facts{{version_name, version},
                 {scene_name, fmt::format("{:016x}", scene_hash)},
                 {"size", fmt::format("{}x{}", options.width, options.height)},
                 {"crop", rect_text(rendered_rect(options))},
                 {std::string(samples_name), std::to_string(options.spp)},
                 {"filter", std::string(name_of(options.filter))},
                 {"seed", std::to_string(options.seed)},
                 {"method", std::string(name_of(options.method))},
                 {"max-depth", std::to_string(options.max_depth)},
                 {"solver", std::string(name_of(options.solver))},
                 {"background", options.transparent ? "transparent" : "opaque"},
                 {"outline", fmt::format("{}", options.outline)},
                 {"aov", aov_text(options.aovs)}};
  if (options.noise > 0) {
    facts.emplace_back("noise", fmt::format("{}", options.noise));
    facts.emplace_back("min-spp", std::to_string(options.min_spp));
    facts.emplace_back("exposure", fmt::format("{}", options.exposure_stops));
  }
  if (options.aa > 0) {
    facts.emplace_back("aa", fmt::format("{}", options.aa));
    facts.emplace_back("exposure", fmt::format("{}", options.exposure_stops));
  }
  if (options.fog > 0) {
    facts.emplace_back("fog", fmt::format("{}", options.fog));
    for (const auto& [name, depth] :
         {std::pair{"fog-from", options.fog_from}, std::pair{"fog-to", options.fog_to}}) {
      if (depth) facts.emplace_back(name, fmt::format("{}", *depth));
    }
  }
  if (options.least_weight > 0)
    facts.emplace_back("least-weight", fmt::format("{}", options.least_weight));
  return facts;
}

std::string find_difference(const RunFacts& found, const RunFacts& wanted, std::string_view but) {
  for (std::size_t i = 0; i < std::max(found.size(), wanted.size()); ++i) {
    if (i >= found.size()) return "does not say its --" + wanted[i].first;
    if (i >= wanted.size())
      return "has --" + printable(found[i].first, 40) + ", which is not known";
    if (found[i].first != wanted[i].first) return "does not say its --" + wanted[i].first;
    if (found[i].second != wanted[i].second && found[i].first != but)
      return in_words(found[i].first, found[i].second, wanted[i].second);
  }
  return {};
}

}  // namespace boule
