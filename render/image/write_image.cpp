#include "render/image/write_image.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <set>

#include "core/base/float_environment.h"
#include "render/image/header_texts.h"
#include "render/image/module_loader.h"
#include "render/image/output_file.h"
#include "render/image/tone.h"

namespace boule {
namespace {

namespace module = image_module;

/// What the module reads: plain structs, and what they point to.
struct Plan {
  std::vector<std::uint8_t> codes;  ///< of LDR formats
  std::vector<module::Channel> channels;
  Metadata metadata;
  std::vector<module::Attribute> attributes;
  module::Picture picture{};
  const std::function<bool()>* stop = nullptr;
  mutable std::exception_ptr thrown{};  ///< what `stop` threw
};

/// No exception may reach the module.
bool ask_to_stop(const void* context) {
  const auto& plan = *static_cast<const Plan*>(context);
  try {
    return *plan.stop && (*plan.stop)();
  } catch (...) {
    plan.thrown = std::current_exception();
    return true;
  }
}

const char* compression_name(Compression compression) {
  switch (compression) {
    case Compression::none:
      return "none";
    case Compression::rle:
      return "rle";
    case Compression::zip:
      break;
  }
  return "zip";
}

std::size_t sample_count(const ImageChannel& channel) {
  return std::visit([](const auto& samples) { return samples.size(); }, channel.samples);
}

/// What is wrong with the extra channels, or an empty text.
std::string channel_problem(const Image& image, const std::vector<ImageChannel>& channels) {
  std::set<std::string> names = {"R", "G", "B"};
  if (!image.alpha.empty()) names.insert("A");
  for (const ImageChannel& channel : channels) {
    if (channel.name.empty() || !names.insert(channel.name).second) {
      return "channel " + quote(channel.name) + " has no name of its own";
    }
    if (sample_count(channel) != image.pixels.size()) {
      return "channel " + quote(channel.name) + " has not one sample per pixel";
    }
  }
  return {};
}

/// What is wrong with the arguments of write_image(), or an empty text.
std::string find_reason(const Image& image, const ImageFileOptions& options,
                        const ImageFormat* format) {
  if (format == nullptr) {
    return unknown_image_extension();
  }
  if (image.width < 1 || image.height < 1 ||
      image.pixels.size() !=
          static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
    return "the picture has no pixels";
  }
  if (!image.alpha.empty() && image.alpha.size() != image.pixels.size()) {
    return "the picture has not one alpha per pixel";
  }
  if (!image.alpha.empty() && !format->alpha) {
    return std::string("a .") + format->extension + " file has no room for transparency";
  }
  if (image.width > format->longest_side || image.height > format->longest_side) {
    return std::string("a .") + format->extension + " file has at most " +
           std::to_string(format->longest_side) + " pixels a side";
  }
  const CropWindow& crop = options.crop;
  if (crop.frame_width != 0 &&
      (crop.x < 0 || crop.y < 0 || crop.frame_width < image.width ||
       crop.frame_height < image.height || crop.x > crop.frame_width - image.width ||
       crop.y > crop.frame_height - image.height)) {
    return "the crop lies outside its frame";
  }
  if (!options.channels.empty() && !format->channels) {
    return std::string("a .") + format->extension + " file has no room for extra channels";
  }
  return channel_problem(image, options.channels);
}

/// R, G, B, and A if the picture has alpha.
void plan_colors(const Image& image, const ImageFormat& format, Plan& plan) {
  static_assert(sizeof(Color) == 3 * sizeof(float));
  constexpr const char* names[] = {"R", "G", "B", "A"};
  const std::size_t count = image.alpha.empty() ? 3 : 4;
  const auto* floats = reinterpret_cast<const unsigned char*>(image.pixels.data());
  const auto* alpha = reinterpret_cast<const unsigned char*>(image.alpha.data());
  for (std::size_t i = 0; i < count; ++i) {
    if (!format.hdr) {
      plan.channels.push_back({names[i], module::SampleType::u8, plan.codes.data() + i, count});
    } else if (i < 3) {
      plan.channels.push_back(
          {names[i], module::SampleType::f32, floats + i * sizeof(float), sizeof(Color)});
    } else {
      plan.channels.push_back({names[i], module::SampleType::f32, alpha, sizeof(float)});
    }
  }
}

void plan_channels(const Image& image, const ImageFileOptions& options, const ImageFormat& format,
                   Plan& plan) {
  if (!format.hdr) plan.codes = tone_map(image, options.exposure_stops);
  plan_colors(image, format, plan);
  for (const ImageChannel& channel : options.channels) {
    const auto* integers = std::get_if<std::vector<std::uint32_t>>(&channel.samples);
    const void* samples = integers != nullptr
                              ? static_cast<const void*>(integers->data())
                              : std::get<std::vector<float>>(channel.samples).data();
    const auto type = integers != nullptr ? module::SampleType::u32 : module::SampleType::f32;
    plan.channels.push_back(
        {channel.name.c_str(), type, static_cast<const unsigned char*>(samples), 4});
  }
}

module::Attribute attribute_of(const std::string& name, const MetadataValue& value) {
  using module::AttributeType;
  if (const auto* text = std::get_if<std::string>(&value)) {
    return {name.c_str(), AttributeType::text, text->c_str()};
  }
  if (const auto* integer = std::get_if<std::int32_t>(&value)) {
    return {name.c_str(), AttributeType::integer, integer};
  }
  if (const auto* real = std::get_if<float>(&value)) {
    return {name.c_str(), AttributeType::real, real};
  }
  return {name.c_str(), AttributeType::matrix, std::get<MetadataMatrix>(value).data()};
}

/// The standard entries of a header, and after them those that were asked for.
Metadata header_of(const ImageFileOptions& options, const ImageFormat& format) {
  const std::string writer = format.writer;
  Metadata header = {{"Software", "boule " BOULE_VERSION},
                     {"DateTime", options.date_time},
                     {"oiio:ColorSpace", format.hdr ? "Linear" : "sRGB"}};
  // Straight colours stay as they are.
  if (format.alpha && !format.hdr) header.emplace_back("oiio:UnassociatedAlpha", 1);
  if (writer == "openexr") {
    header.emplace_back("compression", compression_name(options.compression));
  } else if (writer == "jpeg" || writer == "webp") {
    header.emplace_back("CompressionQuality", 95);
    header.emplace_back("jpeg:subsampling", "4:4:4");
  } else if (writer == "tiff") {
    header.emplace_back("tiff:write_exif", 0);  // or libtiff rereads a half-written file
  }
  header.insert(header.end(), options.metadata.begin(), options.metadata.end());
  return header;
}

/// A Plan on the heap, because its picture points into it.
std::unique_ptr<Plan> make_plan(const Image& image, const ImageFileOptions& options,
                                const ImageFormat& format, Metadata header) {
  auto plan = std::make_unique<Plan>();
  plan_channels(image, options, format, *plan);
  plan->metadata = std::move(header);
  for (const auto& [name, value] : plan->metadata) {
    plan->attributes.push_back(attribute_of(name, value));
  }
  const bool cropped = options.crop.frame_width != 0 && format.channels;
  const CropWindow window =
      cropped ? options.crop : CropWindow{.frame_width = image.width, .frame_height = image.height};
  module::Picture& picture = plan->picture;
  picture.format = format.writer;
  picture.width = image.width;
  picture.height = image.height;
  picture.x = window.x;
  picture.y = window.y;
  picture.frame_width = window.frame_width;
  picture.frame_height = window.frame_height;
  picture.channels = plan->channels.data();
  picture.channel_count = plan->channels.size();
  picture.attributes = plan->attributes.data();
  picture.attribute_count = plan->attributes.size();
  plan->stop = &options.stop;
  picture.stop = ask_to_stop;
  picture.context = plan.get();
  return plan;
}

/// The Diagnostic of a Report, or none if it is `done`.
Status status_of(const module::Report& report, const std::string& path) {
  switch (report.outcome) {
    case module::Outcome::done:
      return {};
    case module::Outcome::stopped:
      return cannot_write(path, "interrupted");
    case module::Outcome::system_error:
      return cannot_write(path, report.code);
    case module::Outcome::failed:
      break;
  }
  return cannot_write(path, report.text);
}

/// Checks that the file can be opened: OpenImageIO opens it next and would not say why it fails.
Status check_openable(const OutputFile& file, const std::string& path) {
  const int descriptor = open(file.path().c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot_write(path, errno);
  close(descriptor);
  return {};
}

/// The header's entries, or what is wrong with the arguments of write_image().
Result<Metadata> make_header(const Image& image, const std::string& path,
                             const ImageFileOptions& options, const ImageFormat* format) {
  if (const std::string reason = find_reason(image, options, format); !reason.empty()) {
    return cannot_write(path, reason);
  }
  Metadata header = header_of(options, *format);
  if (const std::string reason = prepare_header_texts(header, *format); !reason.empty()) {
    return cannot_write(path, reason);
  }
  return header;
}

/// Lets the module write the picture that is planned.
Status write_planned(Plan& plan, const LoadedModule& loaded, const OpenFile& file) {
  plan.picture.threads = loaded.threads;
  module::Report report{};
  loaded.table->write(&plan.picture, file.descriptor, &report);
  if (plan.thrown) std::rethrow_exception(plan.thrown);
  return status_of(report, file.name);
}

Status write_open(const Image& image, const OpenFile& file, const ImageFileOptions& options,
                  const ImageFormat& format) {
  auto header = make_header(image, file.name, options, &format);
  if (!header) return header.error();
  const auto loaded = load_image_module(format, options.threads);
  if (!loaded) return cannot_write(file.name, loaded.error().message);
  const auto plan = make_plan(image, options, format, std::move(header).value());
  return write_planned(*plan, loaded.value(), file);
}

Status write(const Image& image, const std::string& path, const ImageFileOptions& options) {
  const ImageFormat* format = find_image_format(path);
  auto header = make_header(image, path, options, format);
  if (!header) return header.error();
  // The file comes first, so that a missing folder is reported without loading anything.
  Result<OutputFile> created = OutputFile::create(path, options.stop);
  if (!created.ok()) return created.error();
  OutputFile& file = created.value();
  if (options.temporary) options.temporary(file.path());
  const auto loaded = load_image_module(*format, options.threads);
  if (!loaded) return cannot_write(path, loaded.error().message);
  const auto plan = make_plan(image, options, *format, std::move(header).value());
  if (auto failure = write_planned(*plan, loaded.value(), {path, file.descriptor()}))
    return failure;
  if (Status failure = check_openable(file, path)) return failure;
  module::Report report{};
  loaded.value().table->check(&plan->picture, file.path().c_str(), &report);
  if (Status failure = status_of(report, path)) return failure;
  if (Status failure = file.sync()) return failure;
  if (options.temporary) options.temporary({});
  return file.commit(options.stop);
}

/// Calls `write`, and turns its exceptions into Diagnostics about this file.
template <class Write>
Status guarded(const std::string& path, const Write& write) {
  const FloatEnvironment environment;
  try {
    return write();
  } catch (const std::bad_alloc&) {
    return cannot_write(path, ENOMEM);
  } catch (const std::exception& other) {  // of a callback
    return cannot_write(path, other.what());
  } catch (...) {
    return cannot_write(path, "an unknown exception");
  }
}

}  // namespace

Status write_image(const Image& image, const std::string& path, const ImageFileOptions& options) {
  return guarded(path, [&] { return write(image, path, options); });
}

Status write_png(const Image& image, const OpenFile& file, const ImageFileOptions& options) {
  return guarded(file.name, [&] {
    return write_open(image, file, options, *find_image_format("picture.png"));
  });
}

}  // namespace boule
