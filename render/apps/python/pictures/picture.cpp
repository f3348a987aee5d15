#include "render/apps/python/pictures/picture.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <string>
#include <string_view>
#include <utility>

#include "render/apps/job/picture/source_date.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/choices.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/made_by_calls.h"
#include "render/apps/python/values/presence.h"
#include "render/image/encode_image.h"
#include "render/image/tone.h"
#include "render/renderer/aov_channels.h"

namespace py = pybind11;

namespace boule::python {
namespace {

constexpr auto number_size = static_cast<py::ssize_t>(sizeof(float));

std::vector<py::ssize_t> sides_of(const Image& image) { return {image.height, image.width}; }

/// The pixels, H x W x 3, in place.
py::buffer_info buffer_of(const Picture& picture) {
  const Image& image = picture.parts->image;
  const py::ssize_t row = py::ssize_t{3} * image.width;
  auto* const first = const_cast<float*>(&image.pixels.front().r);
  return {first,
          number_size,
          py::format_descriptor<float>::format(),
          3,
          {py::ssize_t{image.height}, py::ssize_t{image.width}, py::ssize_t{3}},
          {row * number_size, 3 * number_size, number_size},
          true};
}

/// For numpy: the pixels in place, or in another type.
py::object as_array(const py::object& picture, const py::object& dtype) {
  const Image& image = py::cast<const Picture&>(picture).parts->image;
  const py::ssize_t row = number_size * 3 * image.width;
  py::array view = view_of<float>(&image.pixels.front().r, {image.height, image.width, 3},
                                  {row, 3 * number_size, number_size}, picture);
  if (dtype.is_none()) return view;
  return view.attr("astype")(dtype, py::arg("copy") = false);
}

py::object alpha_of(const py::object& picture) {
  const Image& image = py::cast<const Picture&>(picture).parts->image;
  if (image.alpha.empty()) return py::none();
  return view_of<float>(image.alpha.data(), sides_of(image),
                        {number_size * image.width, number_size}, picture);
}

/// The extra channels by their names in EXR files, each H x W, in place.
py::dict channels_of(const py::object& picture) {
  const PictureParts& parts = *py::cast<const Picture&>(picture).parts;
  py::dict channels;
  for (const ImageChannel& channel : parts.channels) {
    channels[py::str(channel.name)] = std::visit(
        [&]<class Number>(const std::vector<Number>& samples) {
          constexpr auto size = static_cast<py::ssize_t>(sizeof(Number));
          return view_of<Number>(samples.data(), sides_of(parts.image),
                                 {size * parts.image.width, size}, picture);
        },
        channel.samples);
  }
  return channels;
}

void check_exposure(float exposure) {
  if (!(exposure >= -100 && exposure <= 100)) throw_error("exposure", "must be from -100 to 100");
}

/// What is drawn on the picture as it is shown; null: nothing.
Result<std::shared_ptr<const PixelLayer>> layer_of(const PictureParts& parts, float exposure) {
  if (parts.overlay.is_empty()) return std::shared_ptr<const PixelLayer>();
  return overlay_layer(parts.overlay, parts.image, exposure);
}

/// 8 bits a component: H x W x 3, or x 4 with alpha.
py::array srgb_of(const Picture& picture, float exposure) {
  check_exposure(exposure);
  const auto parts = picture.parts;
  using Codes = Result<std::vector<std::uint8_t>>;
  const auto bytes = take(interruptible([parts, exposure](Call&) -> Codes {
    auto codes = tone_map(parts->image, exposure);
    const auto layer = layer_of(*parts, exposure);
    if (!layer) return layer.error();
    if (layer.value()) draw_over(*layer.value(), 0, parts->image.alpha.empty() ? 3 : 4, codes);
    return codes;
  }));
  auto array = empty_array<std::uint8_t>(
      {parts->image.height, parts->image.width, parts->image.alpha.empty() ? 3 : 4});
  std::copy(bytes.begin(), bytes.end(), array.mutable_data());
  return array;
}

ImageFileOptions file_options(const PictureParts& parts, float exposure) {
  check_exposure(exposure);
  ImageFileOptions options;
  options.exposure_stops = exposure;
  options.crop = parts.crop;
  options.metadata = parts.header;
  options.threads = static_cast<int>(parts.statistics.threads);
  return options;
}

void save(const Picture& picture, const py::object& name, float exposure,
          const std::string& compression) {
  const auto path =
      py::cast<std::string>(py::module_::import("boule._objects").attr("path_of")(name, "path"));
  ImageFileOptions options = file_options(*picture.parts, exposure);
  options.compression = choose<Compression>(compression, "compression");
  options.date_time = take(source_date());
  const ImageFormat* const format = find_image_format(path);
  const bool has_channels = format != nullptr && format->channels;
  const bool is_drawn_on = format != nullptr && !format->hdr;
  check(interruptible(
      [parts = picture.parts, path, options, has_channels, is_drawn_on](Call& call) -> Status {
        ImageFileOptions mine = options;
        // Here, not before: the thread that waits for signals copies nothing large.
        if (has_channels) mine.channels = parts->channels;
        mine.stop = [&call] { return call.cancel.load(); };
        if (is_page_name(path)) return write_page(parts->image, parts->overlay, path, mine);
        if (is_drawn_on) {
          auto layer = layer_of(*parts, options.exposure_stops);
          if (!layer) return layer.error();
          mine.layer = std::move(layer).value();
        }
        return write_image(parts->image, path, mine);
      }));
}

py::bytes png_of(const Picture& picture, float exposure) {
  const ImageFileOptions options = file_options(*picture.parts, exposure);
  const std::string bytes =
      take(interruptible([parts = picture.parts, options](Call& call) -> Result<std::string> {
        ImageFileOptions mine = options;
        auto layer = layer_of(*parts, options.exposure_stops);
        if (!layer) return layer.error();
        mine.layer = std::move(layer).value();
        mine.stop = [&call] { return call.cancel.load(); };
        return encode_image(parts->image, StreamFormat::png, "picture.png", mine);
      }));
  return py::bytes(bytes);
}

py::dict stats_of(const Picture& picture) {
  const PictureParts& parts = *picture.parts;
  const RenderStatistics& all = parts.statistics;
  py::dict values;
  values["prepare_seconds"] = all.prepare_seconds;
  values["render_seconds"] = all.render_seconds;
  values["rays"] = all.rays.total();
  values["isa"] = std::string(all.isa);
  values["width"] = all.width;
  values["threads"] = all.threads;
  values["solver"] = std::string(name_of(all.solver));
  values["spp"] = parts.spp;
  if (parts.noise) {
    values["noise_reached"] = parts.noise->half_width;
    values["mean_spp"] = parts.noise->mean_samples;
    values["settled"] = parts.noise->share;
  }
  values["scene_hash"] = fmt::format("{:016x}", parts.scene_hash);
  return values;
}

/// The share of its samples that a picture has.
double share_of(const Picture& picture) {
  const auto& partial = picture.parts->partial;
  if (!partial) return 1;
  return static_cast<double>(partial->done) / static_cast<double>(partial->all);
}

std::string repr_of(const Picture& picture) {
  const PictureParts& parts = *picture.parts;
  const std::string unfinished =
      parts.partial ? fmt::format(", unfinished: {:.1f} % of its samples", parts.partial->percent())
                    : "";
  return fmt::format("<boule.Picture {} x {}, {} spp{}>", parts.image.width, parts.image.height,
                     parts.spp, unfinished);
}

/// Points that are counted from `origin`, in double, as the scene counts them; 0 stays: a miss.
py::object counted_from_zero(const py::object& points, const Vec3d& origin) {
  const py::module_ numpy = need_numpy();
  const py::object is_hit = points.attr("any")(py::arg("axis") = -1, py::arg("keepdims") = true);
  const py::object zero = numpy.attr("array")(py::make_tuple(origin.x, origin.y, origin.z));
  return numpy.attr("where")(is_hit, zero + points, 0.0);
}

/// The extra channels by AOV: H x W, or H x W x 3, which is a copy.
py::dict aovs_of(const py::object& picture) {
  const py::dict channels = channels_of(picture);
  const Vec3d& origin = py::cast<const Picture&>(picture).parts->origin;
  py::dict aovs;
  for (const AovName& aov : aov_names) {
    AovSelection one;
    one.*aov.wanted = true;
    py::list found;
    for (const std::string& name : AovChannels::names(one)) {
      if (channels.contains(name)) found.append(channels[py::str(name)]);
    }
    if (found.empty()) continue;
    const py::str key{std::string(aov.name)};
    if (found.size() == 1) {
      aovs[key] = found[0];
    } else {
      aovs[key] = need_numpy().attr("stack")(found, py::arg("axis") = -1);
    }
    if (std::string_view(aov.name) == "position" && !(origin == Vec3d{}))
      aovs[key] = counted_from_zero(aovs[key], origin);
  }
  return aovs;
}

constexpr const char* picture_description =
    "A picture that was rendered: linear RGB in float32. It does not change.\n\n"
    "np.asarray(picture) is H x W x 3, row 0 on top, in place and read-only. With alpha\n"
    "(background=\"transparent\") colours are premultiplied. Notebooks show it.";

}  // namespace

void bind_picture(py::module_& module) {
  py::class_<Picture> picture(module, "Picture", py::buffer_protocol(), made_by_calls(),
                              picture_description);
  picture.attr("__module__") = "boule";
  picture.def_buffer(&buffer_of)
      .def_property_readonly(
          "width", [](const Picture& p) { return p.parts->image.width; }, "In pixels.")
      .def_property_readonly(
          "height", [](const Picture& p) { return p.parts->image.height; }, "In pixels.")
      .def_property_readonly(
          "finished", [](const Picture& p) { return !p.parts->partial; },
          "Whether it has all its samples.")
      .def_property_readonly("share", &share_of, "Of its samples that it has, 0 to 1.")
      .def_property_readonly(
          "alpha", py::cpp_function(&alpha_of, inside()),
          "H x W, float32, 0 to 1, how much of each pixel objects cover; or None.")
      .def_property_readonly("channels", py::cpp_function(&channels_of, inside()),
                             "The extra channels by their names in EXR files (Z, N.X, ...): each "
                             "H x W, float32 or uint32, in place.")
      .def_property_readonly(
          "aovs", py::cpp_function(&aovs_of, inside()),
          "The extra channels by AOV: depth, id and z are H x W, in place; "
          "normal, position and albedo H x W x 3, copied. Positions are float64, "
          "and those of the scene, where it has an origin.")
      .def_property_readonly("stats", &stats_of, "What it has cost: times in seconds, rays, ...")
      .def_property_readonly(
          "notes", [](const Picture& p) { return p.parts->notes; },
          "What was decided for the user, a sentence each.")
      .def("to_srgb", &srgb_of, inside(), py::kw_only(), py::arg("exposure") = 0.0F,
           "H x W x 3 of uint8 (x 4, straight, with alpha): codes of the sRGB curve. Colours are "
           "multiplied by 2^exposure, of -100 to 100, and clamped before. Raises Error.")
      .def(
          "save", &save, inside(), py::arg("path"), py::kw_only(), py::arg("exposure") = 0.0F,
          py::arg("compression") = "zip",
          "Write a file in the format of its extension, as `boule render` does: .exr (linear, with "
          "all channels, without an overlay), .png, .jpg and others (8 bits; colours are "
          "multiplied by 2^exposure, of "
          "-100 to 100), .pdf and .svg (what is drawn on it as vectors). It appears under its name "
          "when it is complete. compression, of .exr: "
          "none, rle or zip. Raises Error.")
      .def("__array__", &as_array, inside(), py::arg("dtype") = py::none())
      .def(
          "_repr_png_", [](const Picture& p) { return png_of(p, 0); }, inside(), "For notebooks.")
      .def("__repr__", &repr_of);
}

}  // namespace boule::python
