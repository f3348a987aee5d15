#include "render/scene_file/picture_file.h"

#include "render/file/input_file.h"

namespace boule {

Result<Image> read_picture(const std::string& path, PictureContent content) {
  const auto file = InputFile::open(path);
  if (!file) return file.error();
  return read_image(path, content);
}

}  // namespace boule
