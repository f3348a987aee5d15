#pragma once

#include <cstddef>
#include <cstdint>

/// The interface between the library and boule_overlay.so, the module that uses cairo and pango.
/// Only plain structs and function pointers cross it. Functions may be called by any thread.
namespace boule::overlay_module {

/// Both change with any change of this file. The mark stands in the module's file, so the loader
/// can refuse a module of another version before any of it has run.
inline constexpr std::uint32_t version = 1;
inline constexpr char version_mark[] = "boule overlay module, version 1.";

/// The module's one exported symbol: `const Table* boule_overlay_module()`.
inline constexpr const char* entry_point = "boule_overlay_module";

/// A colour of the sRGB curve, 0..1, not premultiplied.
struct Paint {
  double r, g, b, a;
};

struct Point {
  double x, y;
};

/// How high capital letters are, of the height of the font.
inline constexpr double capital = 0.72;

enum class Shape : std::uint32_t { path, disc, ramp, text };

/// Something to draw. Lengths are points of 1/72 inch, counted from the upper left corner.
struct Item {
  Shape shape;
  /// path: the corners. disc: the centre. ramp: the corner at the upper left, and the opposite one.
  /// text: the left end of its middle line.
  const Point* points;
  std::size_t point_count;
  Paint fill;    ///< a path is closed for it; its alpha may be 0
  Paint stroke;  ///< path, disc, ramp: of the edge
  double width;  ///< of the edge; 0: it has none
  double size;   ///< disc: its radius; text: the height of the font
  Paint halo;    ///< around it, below all items; its alpha may be 0
  double halo_width;
  const char* text;     ///< UTF-8
  const Paint* colors;  ///< ramp: from the lower end to the upper one
  std::size_t color_count;
};

/// A picture of 8 bits, row 0 on top. With four channels its colours are not premultiplied.
struct Picture {
  int width, height;
  int channels;  ///< 3 or 4
  const unsigned char* codes;
};

/// The head of a document.
struct Document {
  const char* title;
  const char* date;  ///< "2026-11-29T07:00:00Z"
  const char* creator;
};

/// Takes bytes of a document; false ends it.
using Sink = bool (*)(void* context, const unsigned char* bytes, std::size_t count);

struct Table {
  std::uint32_t version;
  /// How wide a text is, in points.
  double (*width_of)(const char* text, double size);
  /// Draws onto nothing: width x height pixels, R, G, B, A, not premultiplied, into `codes`. False
  /// if there is no memory for it.
  bool (*draw)(const Item* items, std::size_t count, double pixels_per_point, int width, int height,
               unsigned char* codes);
  /// A PDF of one page, which is as large as the picture in print. False if that fails.
  bool (*write_pdf)(const Item* items, std::size_t count, double pixels_per_point,
                    const Picture* picture, const Document* document, Sink sink, void* context);
};

}  // namespace boule::overlay_module
