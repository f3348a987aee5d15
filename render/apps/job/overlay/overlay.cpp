#include "render/apps/job/overlay/overlay.h"

#include <cerrno>
#include <new>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/base/version.h"
#include "render/apps/job/overlay/overlay_layout.h"
#include "render/apps/job/overlay/svg_page.h"
#include "render/image/module/module_search.h"
#include "render/image/output_file.h"
#include "render/image/tone.h"

namespace boule {
namespace {

using overlay_module::Table;

Diagnostic no_overlay(const std::string& reason) {
  return Diagnostic::of("cannot draw on pictures: " + reason + "; Debian's package " +
                        modules_package +
                        " has it; a build has it if libpango1.0-dev is there, and needs "
                        "libpangocairo-1.0-0");
}

Result<const Table*> open_table() {
  auto table = open_module<Table>("boule_overlay.so", overlay_module::version_mark,
                                  overlay_module::entry_point, overlay_module::version);
  if (table) return table;
  return no_overlay(table.error().message);
}

/// A picture in 8 bits, and what is drawn on it.
struct Shown {
  std::vector<std::uint8_t> codes;
  int channels;
  Drawing drawing{};
};

Shown show(const OverlayFacts& facts, const Image& image, float stops, const Table* table) {
  Shown shown{tone_map(image, stops), image.alpha.empty() ? 3 : 4};
  if (facts.is_empty() || table == nullptr) return shown;
  const TextWidth width_of = [table](const std::string& text, double size) {
    return table->width_of(text.c_str(), size);
  };
  shown.drawing =
      lay_out(facts, {image.width, image.height, shown.channels, shown.codes}, width_of);
  return shown;
}

/// "2026:11:29 07:00:00" as "2026-11-29T07:00:00Z".
std::string iso_date(std::string exif) {
  if (exif.size() != 19) return exif;
  exif[4] = exif[7] = '-';
  exif[10] = 'T';
  return exif + 'Z';
}

/// Where a PDF goes, and why it ended.
struct PdfTarget {
  OutputFile& file;
  const ImageFileOptions& options;
  Status status{};
};

bool take_bytes(void* context, const unsigned char* bytes, std::size_t count) {
  auto& target = *static_cast<PdfTarget*>(context);
  try {
    target.status = target.options.stop && target.options.stop()
                        ? Status(Diagnostic::of("interrupted"))
                        : target.file.write(bytes, count);
  } catch (const std::exception& thrown) {  // none may reach cairo
    target.status = Diagnostic::of(thrown.what());
  }
  return target.status.ok();
}

Status put_pdf(const Shown& shown, const Image& image, const OverlayFacts& facts,
               const Table& table, PdfTarget& target, const std::string& path) {
  const auto items = items_of(shown.drawing);
  const overlay_module::Picture picture{image.width, image.height, shown.channels,
                                        shown.codes.data()};
  const std::string date = iso_date(target.options.date_time);
  const std::string creator = std::string("boule ") + library_version();
  const overlay_module::Document document{"", date.c_str(), creator.c_str()};
  const bool done = table.write_pdf(items.data(), items.size(), facts.pixels_per_point, &picture,
                                    &document, take_bytes, &target);
  if (!target.status) return target.status;
  return done ? Status() : cannot_write(path, "cairo cannot make this page");
}

Status put_page(const Image& image, const OverlayFacts& facts, const std::string& path,
                const ImageFileOptions& options) {
  const bool is_pdf = ascii_lower(path).ends_with(".pdf");
  const Table* table = nullptr;
  if (is_pdf || !facts.is_empty()) {
    const auto opened = open_table();
    if (!opened) return opened.error();
    table = opened.value();
  }
  auto file = OutputFile::create(path, options.stop);
  if (!file) return file.error();
  if (options.temporary) options.temporary(file.value().path());
  const Shown shown = show(facts, image, options.exposure_stops, table);
  Status put;
  if (is_pdf) {
    PdfTarget target{file.value(), options};
    put = put_pdf(shown, image, facts, *table, target, path);
  } else {
    const auto text = svg_page(shown.drawing, image, facts.pixels_per_point, options);
    put = text ? file.value().write(text.value().data(), text.value().size()) : text.error();
  }
  if (!put) return put;
  if (auto done = file.value().sync(); !done) return done;
  if (options.temporary) options.temporary({});
  return file.value().commit(options.stop);
}

}  // namespace

Status check_overlay_module() {
  const auto table = open_table();
  return table ? Status() : Status(table.error());
}

Result<std::shared_ptr<const PixelLayer>> overlay_layer(const OverlayFacts& facts,
                                                        const Image& image, float exposure_stops) {
  const auto table = open_table();
  if (!table) return table.error();
  const Shown shown = show(facts, image, exposure_stops, table.value());
  auto layer = std::make_shared<PixelLayer>();
  layer->width = image.width;
  layer->height = image.height;
  layer->codes.resize(4 * image.pixels.size());
  const auto items = items_of(shown.drawing);
  if (!table.value()->draw(items.data(), items.size(), facts.pixels_per_point, image.width,
                           image.height, layer->codes.data())) {
    return Diagnostic::of("cannot draw on pictures: cairo has at most 32767 pixels a side");
  }
  return std::shared_ptr<const PixelLayer>(std::move(layer));
}

bool is_page_name(const std::string& path) {
  const std::string name = ascii_lower(path);
  return name.ends_with(".pdf") || name.ends_with(".svg");
}

Status write_page(const Image& image, const OverlayFacts& facts, const std::string& path,
                  const ImageFileOptions& options) {
  try {
    return put_page(image, facts, path, options);
  } catch (const std::bad_alloc&) {
    return cannot_write(path, ENOMEM);
  }
}

}  // namespace boule
