#include "render/files/scene_file/toml/toml_packed.h"

#include <string>
#include <utility>
#include <vector>

#include "render/files/packed/packed_file.h"

namespace boule {

Result<PackedPart> open_packed(const std::string& path, const SceneFileOptions& options) {
  const auto file =
      PackedFile::open(path, {.trust = options.trust, .parallel_for = options.parallel_for});
  if (!file) return file.error();
  auto scene = file.value().scene();
  if (!scene) return scene.error();
  return PackedPart{std::move(scene).value(), file.value().contents().origin};
}

std::optional<PackedPart> read_packed(TomlTable& root, const SceneFileOptions& options) {
  std::vector<TomlTable> tables = root.tables("packed");
  if (tables.empty()) return std::nullopt;
  if (tables.size() > 1) {
    tables[1].report("file", "a scene has one packed file at most");
    return std::nullopt;
  }
  TomlTable& table = tables.front();
  std::string name;
  table.read_file_name("file", name);
  table.finish({"file"});
  if (!table.ok()) return std::nullopt;
  auto packed = open_packed(table.file_path(name), options);
  if (packed) return std::move(packed).value();
  table.report("file", quote(name) + ": " + packed.error().message);
  return std::nullopt;
}

}  // namespace boule
