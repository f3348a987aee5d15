#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/parts/part_sheet.h"
#include "render/apps/parts/run_facts.h"
#include "render/frame/pixel_order.h"
#include "render/frame/pixel_rect.h"
#include "render/image/write_image.h"

namespace boule {

/// What a film file says of itself: of which picture it is a part, and of which part.
struct FilmHead {
  RunFacts facts;
  RunFacts share{};   ///< more facts, in which the parts of one picture may differ
  Metadata metadata;  ///< the header that the picture's file will have
  int frame_width = 0, frame_height = 0;
  PixelRect rect;  ///< the picture's pixels: the crop, or the frame
  int spp = 1;
  bool transparent = false;
  PartKinds kinds;
  PixelOrder order = PixelOrder::tiles;  ///< in which it grows: how to show it unfinished
  std::vector<PixelRect> blocks;         ///< that the file holds
};

/// Film files hold samples of pixels in full, so that rendering can go on, or parts be put
/// together, with the same bits. A file is little-endian: a head of 64 bytes with numbers, the
/// facts and the header (ByteWriter), the blocks as four int32 each, their parts (PartSheet), and
/// the XXH3 checksum of all that in 8 bytes.
namespace film_file {

/// An error if this build can neither write nor read film files, because it has no checksum.
Status check_support();

/// Writes the blocks of head.blocks. The file appears when it is complete (OutputFile). `stop` is
/// asked now and then; true makes it fail with "interrupted". Precondition: the blocks lie in the
/// sheet, which has head.kinds.
Status write(const std::string& path, const FilmHead& head, const PartSheet& sheet,
             const std::function<bool()>& stop);

/// A film file that was opened, and whose length and checksum are right.
class Reader {
 public:
  /// Takes any name and any file. The Diagnostic names the file, and says whether it is no film
  /// file, of another version, cut off or changed.
  static Result<Reader> open(const std::string& path);

  [[nodiscard]] const FilmHead& head() const { return head_; }
  /// Puts all blocks into a sheet. Precondition: the sheet has head().rect and head().kinds.
  Status read(PartSheet& sheet) const;

 private:
  Reader() = default;
  std::string parse();
  std::string parse_blocks(std::uint64_t text_bytes, std::uint64_t blocks);

  std::string path_;
  std::string bytes_;
  std::size_t parts_ = 0;  ///< where in `bytes_` the parts begin
  FilmHead head_;
};

}  // namespace film_file
}  // namespace boule
