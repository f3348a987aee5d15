#include "render/apps/job/overlay/svg_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "render/apps/job/picture/legend.h"
#include "render/image/encode_image.h"

namespace boule {
namespace {

using overlay_module::Paint;
using overlay_module::Shape;

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  constexpr const char* letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    unsigned word = 0;
    for (std::size_t i = 0; i < 3; ++i)
      word = word << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U);
    const std::size_t count = std::min<std::size_t>(bytes.size() - at, 3);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= count ? letters[word >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

std::string rgb(const Paint& paint) {
  const auto code = [](double c) { return static_cast<int>(std::lround(c * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", code(paint.r), code(paint.g), code(paint.b));
}

/// How a shape is filled and edged.
std::string painted(const DrawnItem& item) {
  std::string text = " fill=\"" + (item.fill.a > 0 ? rgb(item.fill) : std::string("none")) + "\"";
  if (item.fill.a > 0 && item.fill.a < 1)
    text += fmt::format(" fill-opacity=\"{:g}\"", item.fill.a);
  if (item.width > 0)
    text += fmt::format(" stroke=\"{}\" stroke-width=\"{:.3g}\"", rgb(item.stroke), item.width);
  return text;
}

std::string path_of(const DrawnItem& item) {
  std::string path;
  for (const auto& [x, y] : item.points)
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", x, y);
  if (item.fill.a > 0) path += "Z";
  return "<path d=\"" + path + "\"" + painted(item) + "/>\n";
}

std::string ramp_of(const DrawnItem& item, std::size_t number) {
  const auto& [from, to] = std::pair(item.points[0], item.points[1]);
  std::string text =
      fmt::format("<linearGradient id=\"map{}\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">\n", number);
  for (std::size_t i = 0; i < item.colors.size(); ++i) {
    text += fmt::format("<stop offset=\"{:.6g}\" stop-color=\"{}\"/>\n",
                        static_cast<double>(i) / static_cast<double>(item.colors.size() - 1),
                        rgb(item.colors[i]));
  }
  return text +
         fmt::format(
             "</linearGradient>\n<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
             "height=\"{:.2f}\" fill=\"url(#map{})\" stroke=\"{}\" stroke-width=\"{:.3g}\"/>\n",
             from.x, from.y, to.x - from.x, to.y - from.y, number, rgb(item.stroke), item.width);
}

std::string item_text(const DrawnItem& item, std::size_t number) {
  switch (item.shape) {
    case Shape::path:
      return path_of(item);
    case Shape::ramp:
      return ramp_of(item, number);
    case Shape::disc:
      return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.3g}\"{}/>\n", item.points[0].x,
                         item.points[0].y, item.size, painted(item));
    case Shape::text:
      break;
  }
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.3g}\" fill=\"{}\">{}</text>\n",
                     item.points[0].x, item.points[0].y + overlay_module::capital / 2 * item.size,
                     item.size, rgb(item.fill), xml_text(item.text));
}

/// What is drawn below an item: the item itself, as a wide line.
std::string halo_of(const DrawnItem& item) {
  if (!(item.halo.a > 0)) return {};
  DrawnItem halo = item;
  halo.fill = halo.stroke = item.halo;
  halo.width = item.width + 2 * item.halo_width;
  if (item.shape == Shape::ramp) {
    const auto& [a, b] = std::pair(item.points[0], item.points[1]);
    halo.shape = Shape::path;
    halo.points = {a, {b.x, a.y}, b, {a.x, b.y}};
  }
  const std::string edge =
      fmt::format("<g stroke=\"{}\" stroke-width=\"{:.3g}\">\n", rgb(halo.stroke), halo.width);
  return (item.shape == Shape::text ? edge : "<g>\n") + item_text(halo, 0) + "</g>\n";
}

}  // namespace

Result<std::string> svg_page(const Drawing& drawing, const Image& image, double pixels_per_point,
                             const ImageFileOptions& options) {
  const auto png = encode_image(image, StreamFormat::png, "the picture in the page", options);
  if (!png) return png.error();
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "width=\"{0:.3f}pt\" height=\"{1:.3f}pt\" viewBox=\"0 0 {0:.3f} {1:.3f}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" stroke-linejoin=\"round\">\n"
      "<image width=\"{0:.3f}\" height=\"{1:.3f}\" preserveAspectRatio=\"none\" "
      "xlink:href=\"data:image/png;base64,",
      image.width / pixels_per_point, image.height / pixels_per_point);
  text += base64(png.value()) + "\"/>\n";
  for (const DrawnItem& one : drawing) text += halo_of(one);
  for (std::size_t i = 0; i < drawing.size(); ++i) text += item_text(drawing[i], i);
  return text + "</svg>\n";
}

}  // namespace boule
