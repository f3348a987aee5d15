#include "render/image/finished_picture.h"

#include <filesystem>
#include <system_error>

#include "core/base/float_environment.h"
#include "render/image/built_in_table.h"
#include "render/image/file_damage.h"
#include "render/image/image_format.h"
#include "render/image/module/module_loader.h"

namespace boule {

namespace {

struct Wanted {
  const PictureShape& shape;
  const ImageFormat& format;
};

/// Whether the file has the frame and channels of the shape, as far as the format stores them.
bool has_shape(const void* context, const image_module::FoundPicture& found) {
  const auto& [shape, format] = *static_cast<const Wanted*>(context);
  if (found.partial || found.width != shape.width || found.height != shape.height) return false;
  constexpr int most_without_names = 4;  // R, G, B and alpha
  if (!format.channels) return found.channel_count <= most_without_names;
  const bool cropped = shape.crop.frame_width != 0;
  const CropWindow window =
      cropped ? shape.crop : CropWindow{.frame_width = shape.width, .frame_height = shape.height};
  return found.has_channels && found.x == window.x && found.y == window.y &&
         found.frame_width == window.frame_width && found.frame_height == window.frame_height;
}

}  // namespace

bool is_finished_picture(const std::string& path, const PictureShape& shape) {
  if (shape.width < 1 || shape.height < 1) return false;  // though some files' headers say so
  const FloatEnvironment environment;
  std::error_code ignored;
  const ImageFormat* const format = find_image_format(path);
  // These checks come first, so that the module is not loaded where there is no file.
  if (format == nullptr || path.find('\0') != std::string::npos) return false;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  if (!file_damage(path, *format).empty()) return false;
  const image_module::Table* table = built_in_table(*format);
  if (table == nullptr || table->inspect == nullptr) {
    const auto loaded = load_image_module(*format);
    if (!loaded) return false;
    table = loaded.value().table;
  }
  std::vector<const char*> names = {"R", "G", "B"};
  for (const std::string& name : shape.channels) names.push_back(name.c_str());
  const Wanted shape_and_format{shape, *format};
  const image_module::WantedPicture wanted{.path = path.c_str(),
                                           .format = format->writer,
                                           .channels = names.data(),
                                           .channel_count = names.size(),
                                           .accepts = has_shape,
                                           .context = &shape_and_format};
  image_module::Report report{};
  table->inspect(&wanted, &report);
  return report.outcome == image_module::Outcome::done;
}

}  // namespace boule
