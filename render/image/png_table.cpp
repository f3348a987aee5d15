#include "render/image/built_in_table.h"

#ifdef BOULE_HAS_LIBPNG

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace boule {
namespace {

namespace module = image_module;

constexpr png_uint_32 largest_side = 0x7fffffff;

/// What libpng complained of.
struct Complaint {
  char text[200] = "libpng gives no reason";
};

void keep_complaint(png_structp png, png_const_charp text) {
  auto& complaint = *static_cast<Complaint*>(png_get_error_ptr(png));
  std::snprintf(complaint.text, sizeof complaint.text, "%s", text);
  png_longjmp(png, 1);
}
void ignore_warning(png_structp /*png*/, png_const_charp /*text*/) {}

/// Runs calls of libpng. Where one fails, libpng jumps back here over all of them, and over
/// `calls`, which must not have anything to destroy. Returns whether none failed.
template <class Calls>
[[gnu::noinline]] bool succeed(png_structp png, const Calls& calls) {
  // The documented way: libpng is C, and nothing can be thrown through it.
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp)
  calls();
  return true;
}

/// A file that libpng writes.
class PngWriter {
 public:
  PngWriter(const module::Picture& picture, int descriptor)
      : rows_(picture, descriptor),
        png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint_, keep_complaint,
                                     ignore_warning)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {}
  ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  void begin(module::Report& report) {
    if (info_ == nullptr) throw std::bad_alloc();
    const std::vector<png_text> texts = find_texts();
    const bool begun = succeed(png_, [&] {
      png_set_write_fn(png_, &rows_.sink(), add_bytes, nullptr);
      png_set_user_limits(png_, largest_side, largest_side);
      describe();
      if (!texts.empty()) png_set_text(png_, info_, texts.data(), static_cast<int>(texts.size()));
      png_write_info(png_, info_);
    });
    if (!begun) module::fail(&report, complaint_.text);
  }
  void put(const module::Samples* samples, int rows, module::Report& report) {
    rows_.put(samples, rows, report, [&](const unsigned char* row) {
      const bool written = succeed(png_, [&] { png_write_row(png_, row); });
      if (!written) module::fail(&report, complaint_.text);
      return written;
    });
  }
  void close(module::Report& report) {
    if (!rows_.is_whole()) return;
    if (!succeed(png_, [&] { png_write_end(png_, nullptr); }))
      return module::fail(&report, complaint_.text);
    rows_.finish(report);
  }

 private:
  static void add_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    static_cast<ByteSink*>(png_get_io_ptr(png))->add(bytes, count);
  }

  /// All but the texts, as OpenImageIO has it.
  void describe() {
    const module::Picture& picture = rows_.picture();
    const int color = picture.channel_count == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB;
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(picture.width),
                 static_cast<png_uint_32>(picture.height), 8, color, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    constexpr int usual_level = 6, default_strategy = 0;  // zlib's
    png_set_compression_level(png_, usual_level);
    png_set_compression_strategy(png_, default_strategy);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, PNG_NO_FILTERS);
    png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_ABSOLUTE);
    png_set_oFFs(png_, info_, picture.x, picture.y, PNG_OFFSET_PIXEL);
    if (auto time = find_time()) png_set_tIME(png_, info_, &*time);
    const double x = pixels_per_meter("XResolution"), y = pixels_per_meter("YResolution");
    if (x >= 1 && y >= 1) {
      png_set_pHYs(png_, info_, static_cast<png_uint_32>(x), static_cast<png_uint_32>(y),
                   PNG_RESOLUTION_METER);
    }
  }
  /// A resolution of the header, in pixels per inch there; 0 if it has none.
  [[nodiscard]] double pixels_per_meter(std::string_view name) const {
    constexpr double inch = 0.0254, most = 0x7fffffff;
    const module::Picture& picture = rows_.picture();
    double found = 0;
    for (std::size_t i = 0; i < picture.attribute_count; ++i) {
      const module::Attribute& entry = picture.attributes[i];
      if (entry.type != module::AttributeType::real || name != entry.name) continue;
      found = static_cast<double>(*static_cast<const float*>(entry.value)) / inch;
    }
    return std::clamp(std::floor(found + 0.5), 0.0, most);
  }
  /// That of the text "1970:01:01 00:00:00".
  [[nodiscard]] std::optional<png_time> find_time() const {
    const char* const text = find("DateTime");
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
    if (text == nullptr || std::sscanf(text, "%4d:%2d:%2d %2d:%2d:%2d", &year, &month, &day, &hour,
                                       &minute, &second) != 6)
      return std::nullopt;
    const auto byte = [](int number) { return static_cast<png_byte>(number); };
    return png_time{static_cast<png_uint_16>(year),
                    byte(month),
                    byte(day),
                    byte(hour),
                    byte(minute),
                    byte(second)};
  }
  [[nodiscard]] const char* find(std::string_view name) const {
    const module::Picture& picture = rows_.picture();
    const char* found = nullptr;
    for (std::size_t i = 0; i < picture.attribute_count; ++i) {
      const module::Attribute& entry = picture.attributes[i];
      if (entry.type == module::AttributeType::text && name == entry.name)
        found = static_cast<const char*>(entry.value);
    }
    return found;
  }
  /// Those of the header, under the names that PNG has for them.
  [[nodiscard]] std::vector<png_text> find_texts() const {
    const module::Picture& picture = rows_.picture();
    std::vector<png_text> texts;
    for (std::size_t i = 0; i < picture.attribute_count; ++i) {
      const module::Attribute& entry = picture.attributes[i];
      if (entry.type != module::AttributeType::text || name_in_file(entry.name) == nullptr)
        continue;
      png_text text{};
      text.compression = PNG_TEXT_COMPRESSION_NONE;
      text.key = const_cast<char*>(name_in_file(entry.name));  // libpng copies it
      text.text = const_cast<char*>(static_cast<const char*>(entry.value));
      text.text_length = std::strlen(text.text);
      texts.push_back(text);
    }
    return texts;
  }
  /// Null for what is told otherwise.
  static const char* name_in_file(std::string_view name) {
    if (name == "DateTime") return nullptr;
    if (name == "ImageDescription") return "Description";
    if (name == "Artist") return "Author";
    return name == "DocumentName" ? "Title" : name.data();
  }

  Complaint complaint_;
  RowWriter rows_;
  png_structp png_;
  png_infop info_;
};

/// A file that libpng reads.
class PngReader {
 public:
  explicit PngReader(const char* path)
      : file_(path),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint_, keep_complaint,
                                    ignore_warning)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {}
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Reads up to the first row. False, with a report, if that fails.
  bool begin(module::Report& report) {
    if (info_ == nullptr) throw std::bad_alloc();
    return reported(report, [&] {
      png_set_read_fn(png_, &file_, read_bytes);
      png_set_user_limits(png_, largest_side, largest_side);
      png_read_info(png_, info_);
    });
  }
  /// Reads all rows, and what is behind them.
  void finish(module::Report& report) {
    std::size_t bytes = 0;
    int passes = 0;
    const bool begun = reported(report, [&] {
      passes = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      bytes = png_get_rowbytes(png_, info_);
    });
    if (!begun) return;
    std::vector<png_byte> row(bytes);
    const png_uint_32 rows = height();
    reported(report, [&] {
      for (int pass = 0; pass < passes; ++pass) {
        for (png_uint_32 y = 0; y < rows; ++y) png_read_row(png_, row.data(), nullptr);
      }
      png_read_end(png_, nullptr);
    });
  }

  [[nodiscard]] png_uint_32 width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] png_uint_32 height() const { return png_get_image_height(png_, info_); }
  [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
  [[nodiscard]] int bits() const { return png_get_bit_depth(png_, info_); }
  /// Whether its description begins with this text; of several the last one counts.
  [[nodiscard]] bool is_described(std::string_view begin) const {
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(png_, info_, &texts, &count);
    bool begins = false;
    for (int i = 0; i < count; ++i) {
      const std::string_view key = texts[i].key, text = texts[i].text;
      if (key == "Description" || key == "ImageDescription") begins = text.starts_with(begin);
    }
    return begins;
  }

 private:
  static void read_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    if (static_cast<ByteSource*>(png_get_io_ptr(png))->read(bytes, count) != count)
      png_error(png, "the file ends within the picture");
  }

  template <class Calls>
  bool reported(module::Report& report, const Calls& calls) {
    const bool done = succeed(png_, calls);
    if (!done && !module::fail_by(file_.code(), &report))
      module::fail(&report, std::string("unreadable: ") + complaint_.text);
    return done;
  }

  Complaint complaint_;
  ByteSource file_;
  png_structp png_;
  png_infop info_;
};

module::Writer* opaque(PngWriter* writer) { return reinterpret_cast<module::Writer*>(writer); }
PngWriter* png_writer(module::Writer* writer) { return reinterpret_cast<PngWriter*>(writer); }

void start(const char* /*format*/, int /*threads*/, module::Report* report) { *report = {}; }

module::Writer* open(const module::Picture* picture, int descriptor, module::Report* report) {
  std::unique_ptr<PngWriter> writer;
  module::guarded(report, [&] {
    writer = std::make_unique<PngWriter>(*picture, descriptor);
    writer->begin(*report);
  });
  return report->outcome == module::Outcome::done ? opaque(writer.release()) : nullptr;
}

void put(module::Writer* writer, const module::Samples* samples, int rows, module::Report* report) {
  module::guarded(report, [&] { png_writer(writer)->put(samples, rows, *report); });
}

void close(module::Writer* writer, module::Report* report) {
  const std::unique_ptr<PngWriter> owner(png_writer(writer));
  module::guarded(report, [&] { owner->close(*report); });
}

void check(const module::Picture* picture, const char* path, module::Report* report) {
  module::guarded(report, [&] {
    PngReader file(path);
    if (!file.begin(*report)) return;
    const bool same = file.width() == static_cast<png_uint_32>(picture->width) &&
                      file.height() == static_cast<png_uint_32>(picture->height) &&
                      file.channels() == static_cast<int>(picture->channel_count) &&
                      file.bits() == 8;
    if (!same) return module::fail(report, "the file's header is not what was written");
    file.finish(*report);
  });
}

void inspect(const module::WantedPicture* wanted, module::Report* report) {
  module::guarded(report, [&] {
    PngReader file(wanted->path);
    if (!file.begin(*report)) return;
    const auto width = static_cast<int>(file.width()), height = static_cast<int>(file.height());
    const module::FoundPicture found{.width = width,
                                     .height = height,
                                     .x = 0,
                                     .y = 0,
                                     .frame_width = width,
                                     .frame_height = height,
                                     .channel_count = file.channels(),
                                     .has_channels = false,  // they have no names
                                     .partial = file.is_described("partial: ")};
    if (!wanted->accepts(wanted->context, found)) {
      report->outcome = module::Outcome::stopped;
      return;
    }
    file.finish(*report);
  });
}

constexpr module::Table table = {module::version, start, open, put, close, check, inspect, nullptr};

}  // namespace

const module::Table* png_table() { return &table; }

}  // namespace boule

#else

namespace boule {

const image_module::Table* png_table() { return nullptr; }

}  // namespace boule

#endif
