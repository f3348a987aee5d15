#include "render/image/image_plan.h"

#include <cstddef>
#include <set>

#include "core/base/version.h"
#include "render/image/header_texts.h"
#include "render/image/output_file.h"

namespace boule {
namespace {

namespace module = image_module;

/// No exception may reach the module.
bool ask_to_stop(const void* context) {
  const auto& plan = *static_cast<const ImagePlan*>(context);
  try {
    return plan.stop && plan.stop();
  } catch (...) {
    plan.thrown = std::current_exception();
    return true;
  }
}

/// What is wrong with the extra channels, or an empty text.
std::string channel_problem(const ImageForm& form) {
  std::set<std::string> names = {"R", "G", "B"};
  if (form.alpha != Alpha::none) names.insert("A");
  for (const ChannelForm& channel : form.channels) {
    if (channel.name.empty() || !names.insert(channel.name).second) {
      return "channel " + quote(channel.name) + " has no name of its own";
    }
  }
  return {};
}

/// What is wrong with a picture of this form and its options, or an empty text.
std::string find_reason(const ImageForm& form, const ImageFileOptions& options,
                        const ImageFormat* format) {
  if (format == nullptr) return unknown_image_extension();
  if (form.width < 1 || form.height < 1) return "the picture has no pixels";
  if (form.alpha != Alpha::none && !format->alpha) {
    return std::string("a .") + format->extension + " file has no room for transparency";
  }
  if (form.width > format->longest_side || form.height > format->longest_side) {
    return std::string("a .") + format->extension + " file has at most " +
           std::to_string(format->longest_side) + " pixels a side";
  }
  const CropWindow& crop = options.crop;
  if (crop.frame_width != 0 &&
      (crop.x < 0 || crop.y < 0 || crop.frame_width < form.width ||
       crop.frame_height < form.height || crop.x > crop.frame_width - form.width ||
       crop.y > crop.frame_height - form.height)) {
    return "the crop lies outside its frame";
  }
  if (!form.channels.empty() && !format->channels) {
    return std::string("a .") + format->extension + " file has no room for extra channels";
  }
  if (const auto& layer = options.layer; layer) {
    if (format->hdr)
      return std::string("a .") + format->extension +
             " file has no overlay: its "
             "colours are not those that are shown";
    if (layer->width != form.width || layer->height != form.height)
      return "the overlay is not as large as the picture";
  }
  return channel_problem(form);
}

/// R, G, B, A if the picture has alpha, and the others.
void plan_channels(const ImageForm& form, const ImageFormat& format, ImagePlan& plan) {
  constexpr const char* names[] = {"R", "G", "B", "A"};
  const auto type = format.hdr ? module::SampleType::f32 : module::SampleType::u8;
  const std::size_t count = form.alpha == Alpha::none ? 3 : 4;
  for (std::size_t i = 0; i < count; ++i) plan.channels.push_back({names[i], type});
  for (const ChannelForm& channel : form.channels) {
    plan.channels.push_back({channel.name.c_str(), channel.is_integer ? module::SampleType::u32
                                                                      : module::SampleType::f32});
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
  Metadata header = {{"Software", std::string("boule ") + library_version()},
                     {"DateTime", options.date_time},
                     {"oiio:ColorSpace", format.hdr ? "Linear" : "sRGB"}};
  // Straight colours stay as they are.
  if (format.alpha && !format.hdr) header.emplace_back("oiio:UnassociatedAlpha", 1);
  if (writer == "openexr") {
    header.emplace_back("compression", std::string(name_of(options.compression)));
  } else if (writer == "jpeg" || writer == "webp") {
    header.emplace_back("CompressionQuality", 95);
    header.emplace_back("jpeg:subsampling", "4:4:4");
  } else if (writer == "tiff") {
    header.emplace_back("tiff:write_exif", 0);  // or libtiff rereads a half-written file
  }
  header.insert(header.end(), options.metadata.begin(), options.metadata.end());
  return header;
}

void plan_picture(const ImageFormat& format, const CropWindow& crop, ImagePlan& plan) {
  const ImageForm& form = plan.form;
  const bool cropped = crop.frame_width != 0 && format.channels;
  const CropWindow window =
      cropped ? crop : CropWindow{.frame_width = form.width, .frame_height = form.height};
  module::Picture& picture = plan.picture;
  picture.format = format.writer;
  picture.width = form.width;
  picture.height = form.height;
  picture.x = window.x;
  picture.y = window.y;
  picture.frame_width = window.frame_width;
  picture.frame_height = window.frame_height;
  picture.channels = plan.channels.data();
  picture.channel_count = plan.channels.size();
  picture.attributes = plan.attributes.data();
  picture.attribute_count = plan.attributes.size();
  picture.stop = ask_to_stop;
  picture.context = &plan;
}

}  // namespace

Result<std::unique_ptr<ImagePlan>> make_plan(const ImageForm& form, const std::string& path,
                                             const ImageFileOptions& options,
                                             const ImageFormat* format) {
  if (const std::string reason = find_reason(form, options, format); !reason.empty())
    return cannot_write(path, reason);
  auto plan = std::make_unique<ImagePlan>();
  plan->form = form;
  plan->metadata = header_of(options, *format);
  if (const std::string reason = prepare_header_texts(plan->metadata, *format); !reason.empty())
    return cannot_write(path, reason);
  plan_channels(plan->form, *format, *plan);
  for (const auto& [name, value] : plan->metadata)
    plan->attributes.push_back(attribute_of(name, value));
  plan->stop = options.stop;
  plan_picture(*format, options.crop, *plan);
  return plan;
}

}  // namespace boule
