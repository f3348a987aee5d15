// The image module: the one source that uses OpenImageIO. module_loader.cpp loads it on first use.

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/thread.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/image/module/image_module.h"
#include "render/image/module/module_report.h"
#include "render/image/module/module_writer.h"

namespace boule::image_module {
namespace {

void add_attribute(OIIO::ImageSpec& spec, const Attribute& attribute) {
  switch (attribute.type) {
    case AttributeType::text:
      spec.attribute(attribute.name, static_cast<const char*>(attribute.value));
      break;
    case AttributeType::integer:
      spec.attribute(attribute.name, OIIO::TypeInt, attribute.value);
      break;
    case AttributeType::real:
      spec.attribute(attribute.name, OIIO::TypeFloat, attribute.value);
      break;
    case AttributeType::matrix:
      spec.attribute(attribute.name, OIIO::TypeMatrix44, attribute.value);
      break;
  }
}

OIIO::ImageSpec spec_of(const Picture& picture) {
  const auto count = static_cast<int>(picture.channel_count);
  OIIO::ImageSpec spec(picture.width, picture.height, count, type_of(picture.channels[0].type));
  spec.x = picture.x;
  spec.y = picture.y;
  spec.full_width = picture.frame_width;
  spec.full_height = picture.frame_height;
  spec.channelnames.clear();
  bool mixed = false;
  for (size_t i = 0; i < picture.channel_count; ++i) {
    const Channel& channel = picture.channels[i];
    spec.channelnames.emplace_back(channel.name);
    spec.channelformats.push_back(type_of(channel.type));
    mixed = mixed || channel.type != picture.channels[0].type;
  }
  if (!mixed) spec.channelformats.clear();
  for (size_t i = 0; i < picture.attribute_count; ++i) add_attribute(spec, picture.attributes[i]);
  return spec;
}

/// The sizes of the two thread pools; 1 means that there is none. Only `start` changes them, one
/// call at a time.
int pool_threads = 1, exr_threads = 1;

/// Makes OpenEXR's pool larger, never smaller. OpenImageIO takes -1 for "no pool", and tells
/// OpenEXR when the next writer is made.
void start_exr_threads(int threads) {
  exr_threads = std::max(exr_threads, threads);
  OIIO::attribute("exr_threads", exr_threads > 1 ? exr_threads : -1);
}

/// Sets the size of OpenImageIO's pool before OpenImageIO starts one of its own size. Setting the
/// size to 1 would start a pool, so for one thread nothing is set here, but for each file that is
/// opened. TIFF uses the pool in any case.
void start_threads(const char* format, int threads) {
  if (threads > pool_threads) OIIO::attribute("threads", threads);
  if (threads > pool_threads || format == std::string_view("tiff")) OIIO::default_thread_pool();
  pool_threads = std::max(pool_threads, threads);
  if (format == std::string_view("openexr")) start_exr_threads(threads);
  OIIO::ImageOutput::create(format);
}

/// A reader that uses the caller's thread only; null if there is none for this format.
std::unique_ptr<OIIO::ImageInput> make_input(const char* format) {
  auto input = OIIO::ImageInput::create(format);
  if (input) input->threads(1);
  return input;
}

/// Whether a file's header has all that was wanted; formats may keep channels in another order.
bool same_shape(const OIIO::ImageSpec& found, const OIIO::ImageSpec& wanted) {
  if (found.width != wanted.width || found.height != wanted.height ||
      found.nchannels != wanted.nchannels || found.x != wanted.x || found.y != wanted.y) {
    return false;
  }
  for (int i = 0; i < wanted.nchannels; ++i) {
    const std::string& name = wanted.channelnames[static_cast<size_t>(i)];
    const int at = found.channelindex(name);
    if (at < 0 || found.channelformat(at) != wanted.channelformat(i)) return false;
  }
  return true;
}

void check_picture(const Picture& picture, const char* path, Report* report) {
  const auto input = make_input(picture.format);
  OIIO::ImageSpec found;
  if (!input || !input->open(path, found)) {
    return fail(report, "unreadable: " + reason_of(input ? input->geterror() : OIIO::geterror()));
  }
  if (!same_shape(found, spec_of(picture))) {
    return fail(report, "the file's header is not what was written");
  }
  std::vector<unsigned char> row(static_cast<size_t>(found.scanline_bytes(true)));
  for (const int y : {found.y, found.y + found.height - 1}) {  // the top row is the last one in BMP
    if (!input->read_scanline(y, 0, OIIO::TypeUnknown, row.data())) {
      return fail(report, "unreadable: " + reason_of(input->geterror()));
    }
  }
}

bool has_channels(const OIIO::ImageSpec& found, const WantedPicture& wanted) {
  const auto* const end = wanted.channels + wanted.channel_count;
  return static_cast<size_t>(found.nchannels) == wanted.channel_count &&
         std::all_of(wanted.channels, end,
                     [&](const char* name) { return found.channelindex(name) >= 0; });
}

void inspect_picture(const WantedPicture& wanted, Report* report) {
  const auto input = make_input(wanted.format);
  OIIO::ImageSpec found;
  if (!input || !input->open(wanted.path, found)) {
    return fail(report, "unreadable: " + reason_of(input ? input->geterror() : OIIO::geterror()));
  }
  const std::string description = found.get_string_attribute("ImageDescription");
  const FoundPicture picture{.width = found.width,
                             .height = found.height,
                             .x = found.x,
                             .y = found.y,
                             .frame_width = found.full_width,
                             .frame_height = found.full_height,
                             .channel_count = found.nchannels,
                             .has_channels = has_channels(found, wanted),
                             .partial = description.rfind("partial: ", 0) == 0};
  if (!wanted.accepts(wanted.context, picture)) {
    report->outcome = Outcome::stopped;
    return;
  }
  std::vector<unsigned char> row(static_cast<size_t>(found.scanline_bytes(true)));
  for (int y = found.y; y < found.y + found.height; ++y) {
    if (!input->read_scanline(y, 0, OIIO::TypeUnknown, row.data())) {
      return fail(report, "unreadable: " + reason_of(input->geterror()));
    }
  }
}

/// An integer as 0..1, divided here: OpenImageIO multiplies, which gives another last bit.
float number_of(unsigned short code) { return static_cast<float>(code) / 65535.0F; }
float number_of(float number) { return number; }

/// The first channels of rows [begin, end), counted from the top, as `type`.
bool read_band(OIIO::ImageInput& input, int begin, int end, int channels,
               const OIIO::TypeDesc& type, void* to) {
  const OIIO::ImageSpec& spec = input.spec();
  const int y = spec.y + begin, y_end = spec.y + end;
  if (spec.tile_width == 0) {
    return input.read_scanlines(0, 0, y, y_end, 0, 0, channels, type, to);
  }
  return input.read_tiles(0, 0, spec.x, spec.x + spec.width, y, y_end, 0, 1, 0, channels, type, to);
}

/// Reads the first channels as `Sample` and makes three numbers per pixel of them.
template <class Sample>
bool read_samples(OIIO::ImageInput& input, OIIO::TypeDesc type, const PictureFile& file) {
  const OIIO::ImageSpec& spec = input.spec();
  const int channels = std::min(spec.nchannels, 3);
  // Every call makes OpenImageIO reserve 64 MiB, even for a narrow picture.
  constexpr int least_rows = 64, enough_pixels = 1 << 16;
  const int rows = std::max(least_rows, enough_pixels / spec.width);
  const int band = spec.tile_height > 0 ? spec.tile_height : rows;
  const auto stride = static_cast<size_t>(channels);
  std::vector<Sample> samples;
  for (int begin = 0, end = 0; begin < spec.height; begin = end) {
    end = std::min(begin + band, spec.height);
    const auto pixels = static_cast<size_t>(end - begin) * static_cast<size_t>(spec.width);
    samples.resize(pixels * stride);
    if (!read_band(input, begin, end, channels, type, samples.data())) return false;
    float* to = file.next(file.context, end - begin);
    for (size_t i = 0; i < pixels; ++i, to += 3) {
      const Sample* pixel = samples.data() + i * stride;
      to[0] = number_of(pixel[0]);
      to[1] = channels == 1 ? to[0] : number_of(pixel[1]);
      to[2] = channels == 1 ? to[0] : channels == 2 ? 0.0F : number_of(pixel[2]);
    }
  }
  return true;
}

void read_picture(PictureFile& file, Report* report) {
  const auto input = make_input(file.format);
  OIIO::ImageSpec spec, wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);  // colours stay as they are in the file
  if (!input || !input->open(file.path, spec, wishes)) {
    return fail(report, reason_of(input ? input->geterror() : OIIO::geterror()));
  }
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.deep) {
    return fail(report, "it is no flat picture");
  }
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height) {
    return fail(report, "it is a part of a picture: its data window is not its display window");
  }
  if (!file.begin(file.context, spec.width, spec.height)) {
    report->outcome = Outcome::stopped;
    return;
  }
  const bool done = spec.format.is_floating_point()
                        ? read_samples<float>(*input, OIIO::TypeDesc::FLOAT, file)
                        : read_samples<unsigned short>(*input, OIIO::TypeDesc::UINT16, file);
  if (!done) return fail(report, reason_of(input->geterror()));
  file.is_integer = !spec.format.is_floating_point();
}

void start(const char* format, int threads, Report* report) {
  guarded(report, [&] { start_threads(format, threads); });
}

Writer* open(const Picture* picture, int descriptor, Report* report) {
  std::unique_ptr<Writer> writer;
  guarded(report, [&] {
    writer = std::make_unique<Writer>(*picture, descriptor);
    writer->open(spec_of(*picture), report);
  });
  return report->outcome == Outcome::done ? writer.release() : nullptr;
}

void put(Writer* writer, const Samples* samples, int rows, Report* report) {
  guarded(report, [&] { writer->put(samples, rows, report); });
}

void close(Writer* writer, Report* report) {
  const std::unique_ptr<Writer> owner(writer);
  guarded(report, [&] { writer->close(report); });
}

void check(const Picture* picture, const char* path, Report* report) {
  guarded(report, [&] { check_picture(*picture, path, report); });
}

void inspect(const WantedPicture* wanted, Report* report) {
  guarded(report, [&] { inspect_picture(*wanted, report); });
}

void read(PictureFile* file, Report* report) {
  guarded(report, [&] { read_picture(*file, report); });
}

constexpr Table table = {version, start, open, put, close, check, inspect, read};

/// What the loader looks for in the file before it runs any of the module.
[[gnu::used]] constexpr auto mark = std::to_array(version_mark);

}  // namespace
}  // namespace boule::image_module

extern "C" [[gnu::visibility("default")]] const boule::image_module::Table* boule_image_module() {
  OIIO::attribute("debug", 0);  // or it prints what it thinks of a header
  return &boule::image_module::table;
}
