#include "render/files/scene_file/toml/picture_file.h"

#include "render/files/file/input_file.h"
#include "render/files/scene_file/loaded/scene_data.h"

namespace boule {

Result<Image> read_picture(const std::string& path, PictureContent content) {
  const auto file = InputFile::open(path);
  if (!file) return file.error();
  return read_image(path, content);
}

Result<Image> read_picture(TomlTable& table, const std::string& name, PictureContent content) {
  const SceneData* const data = table.data();
  if (const Image* known = find_data(data != nullptr ? &data->pictures : nullptr, name)) {
    return *known;
  }
  return read_picture(table.file_path(name), content);
}

}  // namespace boule
