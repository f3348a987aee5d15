#include "render/image/finished_picture.h"

#include <filesystem>
#include <system_error>

#include "core/base/float_environment.h"
#include "render/image/image_format.h"
#include "render/image/image_loader.h"
#include "render/image/whole_file.h"

namespace boule {

bool is_finished_picture(const std::string& path, int width, int height) {
  const FloatEnvironment environment;
  std::error_code ignored;
  const ImageFormat* const format = find_image_format(path);
  // First: without a file nothing needs to be loaded.
  if (format == nullptr || !std::filesystem::is_regular_file(path, ignored)) return false;
  if (!is_whole_file(path, *format)) return false;
  const auto loaded = load_image_module(*format);
  if (!loaded) return false;
  image_module::FoundPicture found{};
  image_module::Report report{};
  loaded.value()->inspect(path.c_str(), format->writer, &found, &report);
  return report.outcome == image_module::Outcome::done && found.width == width &&
         found.height == height && !found.partial;
}

}  // namespace boule
