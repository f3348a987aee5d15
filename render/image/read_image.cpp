#include "render/image/read_image.h"

#include <new>
#include <utility>

#include "core/base/float_environment.h"
#include "core/math/srgb.h"
#include "core/scene/scene.h"
#include "render/image/file_damage.h"
#include "render/image/image_format.h"
#include "render/image/module/module_loader.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

namespace module = image_module;

constexpr const char* too_large = "it needs more memory than there is";

Diagnostic cannot_read_image(const std::string& path, const std::string& reason) {
  return Diagnostic::in_file(path, "cannot read it: " + reason);
}

/// What the module's reader fills, and why it was refused.
struct Room {
  Image image;
  std::string refusal = too_large;
};

bool begin_room(Room& room, int width, int height) {
  if (width > max_image_side || height > max_image_side) {
    room.refusal = "it has more than " + std::to_string(max_image_side) + " pixels a side";
    return false;
  }
  // The module's reader holds as much again.
  const std::uint64_t bytes =
      2 * sizeof(Color) * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (const auto done = check_memory(bytes, "it needs"); !done) {
    room.refusal = done.error().message;
    return false;
  }
  room.image.width = width;
  room.image.height = height;
  room.image.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return true;
}

/// No exception may reach the module.
bool begin(void* context, int width, int height) {
  try {
    return begin_room(*static_cast<Room*>(context), width, height);
  } catch (const std::bad_alloc&) {
    return false;  // the refusal is `too_large` already
  }
}

float* next_rows(void* context, int rows) {
  Image& image = static_cast<Room*>(context)->image;
  const std::size_t done = image.pixels.size();
  image.pixels.resize(done +
                      static_cast<std::size_t>(rows) * static_cast<std::size_t>(image.width));
  static_assert(sizeof(Color) == 3 * sizeof(float));
  return &image.pixels[done].r;
}

void make_linear(Image& image) {
  const auto linear = [](float code) {
    return static_cast<float>(linear_from_srgb(static_cast<double>(code)));
  };
  for (Color& c : image.pixels) c = {linear(c.r), linear(c.g), linear(c.b)};
}

Result<Image> read(const std::string& path, PictureContent content) {
  const ImageFormat* format = find_image_format(path);
  if (format == nullptr) {
    return cannot_read_image(path,
                             "unknown extension, expected one of " + known_image_extensions());
  }
  if (path.find('\0') != std::string::npos)
    return cannot_read_image(path, "its name holds a NUL byte");
  if (const auto damage = file_damage(path, *format); !damage.empty())
    return cannot_read_image(path, damage);
  const auto loaded = load_image_module(*format);
  if (!loaded) return cannot_read_image(path, loaded.error().message);
  Room room;
  module::PictureFile file{.path = path.c_str(),
                           .format = format->writer,
                           .begin = begin,
                           .next = next_rows,
                           .context = &room,
                           .is_integer = false};
  module::Report report{};
  loaded.value().table->read(&file, &report);
  if (report.outcome == module::Outcome::stopped) return cannot_read_image(path, room.refusal);
  if (report.outcome != module::Outcome::done) return cannot_read_image(path, report.text);
  if (content == PictureContent::colors && file.is_integer) make_linear(room.image);
  return std::move(room.image);
}

}  // namespace

Result<Image> read_image(const std::string& path, PictureContent content) {
  const FloatEnvironment environment;
  try {
    return read(path, content);
  } catch (const std::bad_alloc&) {
    return cannot_read_image(path, too_large);
  }
}

}  // namespace boule
