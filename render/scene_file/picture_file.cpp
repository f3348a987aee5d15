#include "render/scene_file/picture_file.h"

#include "render/file/input_file.h"
#include "render/scene_file/scene_data.h"

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
