// The overlay module: the one source that uses cairo and pango. overlay_table.cpp loads it on first
// use.
#include "render/apps/job/overlay/overlay_module.h"

#include <pango/pangocairo.h>

#ifdef CAIRO_HAS_PDF_SURFACE
#include <cairo-pdf.h>
#endif

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace boule::overlay_module {
namespace {

template <auto release>
struct Release {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, Release<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Release<cairo_destroy>>;
using Pattern = std::unique_ptr<cairo_pattern_t, Release<cairo_pattern_destroy>>;
using Options = std::unique_ptr<cairo_font_options_t, Release<cairo_font_options_destroy>>;
using Font = std::unique_ptr<PangoFontDescription, Release<pango_font_description_free>>;
using Layout = std::unique_ptr<PangoLayout, Release<g_object_unref>>;

void set_color(cairo_t* to, const Paint& paint) {
  cairo_set_source_rgba(to, paint.r, paint.g, paint.b, paint.a);
}

/// A line of text. A point is a unit, and glyphs are where they would be at any resolution.
Layout layout_of(cairo_t* to, const char* text, double size) {
  Layout layout(pango_cairo_create_layout(to));
  PangoContext* const context = pango_layout_get_context(layout.get());
  pango_cairo_context_set_resolution(context, 72);
  const Options options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(context, options.get());
  pango_context_set_round_glyph_positions(context, FALSE);
  const Font font(pango_font_description_from_string("Helvetica,Arial,sans-serif"));
  pango_font_description_set_size(font.get(), static_cast<int>(size * PANGO_SCALE));
  pango_layout_set_font_description(layout.get(), font.get());
  pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  pango_layout_set_text(layout.get(), text, -1);
  return layout;
}

/// The middle of a text's capital letters is at the item's point.
void draw_text(cairo_t* to, const Item& item, bool as_halo) {
  const Layout layout = layout_of(to, item.text, item.size);
  const double baseline = pango_layout_get_baseline(layout.get()) / double{PANGO_SCALE};
  cairo_move_to(to, item.points[0].x, item.points[0].y + capital / 2 * item.size - baseline);
  if (as_halo) return pango_cairo_layout_path(to, layout.get());
  set_color(to, item.fill);
  pango_cairo_show_layout(to, layout.get());
}

void stroke(cairo_t* to, const Item& item) {
  if (item.width > 0) {
    set_color(to, item.stroke);
    cairo_set_line_width(to, item.width);
    cairo_stroke(to);
  }
  cairo_new_path(to);
}

/// The outline of what is no text.
void add_outline(cairo_t* to, const Item& item) {
  constexpr double turn = 6.283185307179586;
  const Point* const points = item.points;
  cairo_new_path(to);
  if (item.shape == Shape::disc) return cairo_arc(to, points[0].x, points[0].y, item.size, 0, turn);
  if (item.shape == Shape::ramp) {
    return cairo_rectangle(to, points[0].x, points[0].y, points[1].x - points[0].x,
                           points[1].y - points[0].y);
  }
  for (std::size_t i = 0; i < item.point_count; ++i) cairo_line_to(to, points[i].x, points[i].y);
  if (item.fill.a > 0) cairo_close_path(to);
}

void draw_halo(cairo_t* to, const Item& item) {
  if (!(item.halo.a > 0)) return;
  item.shape == Shape::text ? draw_text(to, item, true) : add_outline(to, item);
  set_color(to, item.halo);
  cairo_set_line_width(to, item.width + 2 * item.halo_width);
  cairo_stroke(to);
}

void draw_ramp(cairo_t* to, const Item& item) {
  const double top = item.points[0].y, bottom = item.points[1].y;
  const Pattern ramp(cairo_pattern_create_linear(0, bottom, 0, top));
  for (std::size_t i = 0; i < item.color_count; ++i) {
    const Paint& color = item.colors[i];
    const double at = item.color_count > 1
                          ? static_cast<double>(i) / static_cast<double>(item.color_count - 1)
                          : 0;
    cairo_pattern_add_color_stop_rgb(ramp.get(), at, color.r, color.g, color.b);
  }
  add_outline(to, item);
  cairo_set_source(to, ramp.get());
  cairo_fill_preserve(to);
  stroke(to, item);
}

void draw_item(cairo_t* to, const Item& item) {
  if (item.shape == Shape::text) return draw_text(to, item, false);
  if (item.shape == Shape::ramp) return draw_ramp(to, item);
  add_outline(to, item);
  if (item.fill.a > 0) {
    set_color(to, item.fill);
    cairo_fill_preserve(to);
  }
  stroke(to, item);
}

void draw_items(cairo_t* to, const Item* items, std::size_t count) {
  cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
  for (std::size_t i = 0; i < count; ++i) draw_halo(to, items[i]);
  for (std::size_t i = 0; i < count; ++i) draw_item(to, items[i]);
}

double width_of(const char* text, double size) {
  const Surface none(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const Context to(cairo_create(none.get()));
  const Layout layout = layout_of(to.get(), text, size);
  PangoRectangle extent{};
  pango_layout_get_extents(layout.get(), nullptr, &extent);
  return extent.width / double{PANGO_SCALE};
}

/// A pixel of cairo as R, G, B, A; and back.
void put_straight(std::uint32_t pixel, unsigned char* to) {
  const std::uint32_t a = pixel >> 24;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t c = pixel >> (16 - 8 * i) & 255;
    to[i] = static_cast<unsigned char>(a == 0 ? 0 : std::min((c * 255 + a / 2) / a, 255U));
  }
  to[3] = static_cast<unsigned char>(a);
}
std::uint32_t premultiplied(const unsigned char* from, int channels) {
  const std::uint32_t a = channels == 4 ? from[3] : 255;
  std::uint32_t pixel = a << 24;
  for (int i = 0; i < 3; ++i) pixel |= ((from[i] * a + 127) / 255) << (16 - 8 * i);
  return pixel;
}

bool is_good(const Surface& surface) {
  return cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS;
}

std::uint32_t* row_of(const Surface& surface, int y) {
  auto* const first = cairo_image_surface_get_data(surface.get());
  return reinterpret_cast<std::uint32_t*>(
      first + std::ptrdiff_t{y} * cairo_image_surface_get_stride(surface.get()));
}

bool draw(const Item* items, std::size_t count, double pixels_per_point, int width, int height,
          unsigned char* codes) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
  if (!is_good(surface)) return false;
  {
    const Context to(cairo_create(surface.get()));
    cairo_scale(to.get(), pixels_per_point, pixels_per_point);
    draw_items(to.get(), items, count);
    if (cairo_status(to.get()) != CAIRO_STATUS_SUCCESS) return false;
  }
  cairo_surface_flush(surface.get());
  for (int y = 0; y < height; ++y) {
    const std::uint32_t* const row = row_of(surface, y);
    for (int x = 0; x < width; ++x, codes += 4) put_straight(row[x], codes);
  }
  return true;
}

#ifdef CAIRO_HAS_PDF_SURFACE
struct Stream {
  Sink sink;
  void* context;
};

cairo_status_t pass_on(void* closure, const unsigned char* bytes, unsigned count) {
  const auto& stream = *static_cast<const Stream*>(closure);
  return stream.sink(stream.context, bytes, count) ? CAIRO_STATUS_SUCCESS
                                                   : CAIRO_STATUS_WRITE_ERROR;
}

Surface surface_of(const Picture& picture) {
  const auto format = picture.channels == 4 ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24;
  Surface surface(cairo_image_surface_create(format, picture.width, picture.height));
  if (!is_good(surface)) return surface;
  const unsigned char* from = picture.codes;
  for (int y = 0; y < picture.height; ++y) {
    std::uint32_t* const row = row_of(surface, y);
    for (int x = 0; x < picture.width; ++x, from += picture.channels)
      row[x] = premultiplied(from, picture.channels);
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

bool write_pdf(const Item* items, std::size_t count, double pixels_per_point,
               const Picture* picture, const Document* document, Sink sink, void* context) {
  Stream stream{sink, context};
  const double scale = 1 / pixels_per_point;
  const Surface page(cairo_pdf_surface_create_for_stream(pass_on, &stream, picture->width * scale,
                                                         picture->height * scale));
  const Surface image = surface_of(*picture);
  if (!is_good(page) || !is_good(image)) return false;
  cairo_pdf_surface_set_metadata(page.get(), CAIRO_PDF_METADATA_TITLE, document->title);
  cairo_pdf_surface_set_metadata(page.get(), CAIRO_PDF_METADATA_CREATE_DATE, document->date);
  cairo_pdf_surface_set_metadata(page.get(), CAIRO_PDF_METADATA_CREATOR, document->creator);
  {
    const Context to(cairo_create(page.get()));
    cairo_save(to.get());
    cairo_scale(to.get(), scale, scale);
    cairo_set_source_surface(to.get(), image.get(), 0, 0);
    cairo_paint(to.get());
    cairo_restore(to.get());
    draw_items(to.get(), items, count);
    if (cairo_status(to.get()) != CAIRO_STATUS_SUCCESS) return false;
  }
  cairo_surface_finish(page.get());
  return is_good(page);
}
#else
bool write_pdf(const Item*, std::size_t, double, const Picture*, const Document*, Sink, void*) {
  return false;
}
#endif

constexpr Table table = {version, width_of, draw, write_pdf};

/// What the loader looks for in the file before it runs any of the module.
[[gnu::used]] constexpr auto mark = std::to_array(version_mark);

}  // namespace
}  // namespace boule::overlay_module

extern "C" [[gnu::visibility("default")]] const boule::overlay_module::Table*
boule_overlay_module() {
  return &boule::overlay_module::table;
}
