#pragma once

#include <string>
#include <vector>

#include "render/image/image_format.h"
#include "render/image/module/byte_sink.h"
#include "render/image/module/byte_source.h"
#include "render/image/module/image_module.h"
#include "render/image/module/module_report.h"

namespace boule {

/// The functions for a format that the program writes without OpenImageIO, whose libraries take a
/// fifth of a second to load: PPM, and PNG if the program was built with libpng. With Boule's
/// headers, the files equal those of OpenImageIO. Null for other formats. `read` is null, and so is
/// `inspect` of PPM: these need OpenImageIO.
const image_module::Table* built_in_table(const ImageFormat& format);

/// The same for PNG alone (png_table.cpp).
const image_module::Table* png_table();

/// The common part of the tables: a picture of 8 bits that is written row by row.
class RowWriter {
 public:
  /// `picture` must outlive it.
  RowWriter(const image_module::Picture& picture, int descriptor)
      : picture_(picture), sink_(descriptor) {}

  /// Calls write(row) for the next rows, the samples of each pixel side by side. Ends early if the
  /// picture's `stop` returns true, or if writing to the file fails.
  template <class Write>
  void put(const image_module::Samples* samples, int rows, image_module::Report& report,
           const Write& write) {
    row_.resize(row_bytes());
    for (int row = 0; row < rows; ++row) {
      gather(samples, static_cast<std::size_t>(row));
      if (!write(row_.data()) || image_module::fail_by(sink_.code(), &report) || is_stopped(report))
        return;
      ++written_;
    }
  }
  /// Ends the file.
  void finish(image_module::Report& report) {
    sink_.flush();
    image_module::fail_by(sink_.code(), &report);
  }

  [[nodiscard]] bool is_whole() const { return written_ == picture_.height; }
  [[nodiscard]] const image_module::Picture& picture() const { return picture_; }
  [[nodiscard]] std::size_t row_bytes() const {
    return static_cast<std::size_t>(picture_.width) * picture_.channel_count;
  }
  [[nodiscard]] ByteSink& sink() { return sink_; }

 private:
  static constexpr std::size_t often_asked = 1 << 20;

  void gather(const image_module::Samples* samples, std::size_t row);
  bool is_stopped(image_module::Report& report);

  const image_module::Picture& picture_;
  ByteSink sink_;
  std::vector<unsigned char> row_;
  int written_ = 0;
  std::size_t since_asked_ = often_asked;  ///< bytes written since the last call of `stop`
};

}  // namespace boule
