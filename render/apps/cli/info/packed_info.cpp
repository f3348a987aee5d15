#include "render/apps/cli/info/packed_info.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "render/apps/cli/info/scene_info.h"
#include "render/files/packed/packed_file.h"

namespace boule::cli {
namespace {

using Json = nlohmann::ordered_json;

Json sections_info(const PackedFile& file) {
  Json list = Json::array();
  for (const packed_format::Section& section : file.sections()) {
    list.push_back({{"name", name_of(section.kind)},
                    {"chunk", section.chunk},
                    {"offset", section.offset},
                    {"bytes", section.bytes}});
  }
  return list;
}

}  // namespace

Result<Json> packed_info(const InfoCommand& command, const std::string& path,
                         const SceneFileOptions& options) {
  const auto file =
      PackedFile::open(path, {.trust = options.trust, .parallel_for = options.parallel_for});
  if (!file) return file.error();
  if (command.verify) {
    if (auto done = file.value().verify(options.parallel_for); !done) return done.error();
  }
  auto scene = file.value().scene();
  if (!scene) return scene.error();
  LoadedScene loaded;
  loaded.scene = std::move(scene).value();
  loaded.origin = file.value().contents().origin;
  Json json = scene_info(std::move(loaded), path);
  json["chunks"] = file.value().contents().chunks.size();
  json["sections"] = sections_info(file.value());
  if (command.verify) json["verified"] = true;
  return json;
}

}  // namespace boule::cli
