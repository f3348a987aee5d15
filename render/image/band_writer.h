#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/image/image.h"
#include "render/image/write_image.h"

namespace boule {

/// The name and the type of an ImageChannel.
struct ChannelForm {
  std::string name;
  bool is_integer = false;  ///< uint32, not float
};

/// The form of a picture, known before its pixels.
struct ImageForm {
  int width = 0;
  int height = 0;
  Alpha alpha = Alpha::none;
  std::vector<ChannelForm> channels{};
};

/// Writes a picture like write_image(), but takes it in bands of rows from the top, so only a part
/// of it need be in memory. The file has the same bytes for any height of the bands. A writer that
/// is destroyed unfinished leaves an old file as it was and removes the new one. Diagnostics are
/// those of write_image(), for exceptions of callbacks, too; after one, every call fails. Threads
/// may take turns in using it, one at a time.
class BandWriter {
 public:
  /// Begins the file. `form` lists the channels; options.channels is ignored.
  static Result<BandWriter> open(const ImageForm& form, const std::string& path,
                                 const ImageFileOptions& options = {});
  /// The same for a PNG into a file of the caller's, which is left unchecked. options.temporary is
  /// not called. The objects in `file` must outlive the writer.
  static Result<BandWriter> open_png(const ImageForm& form, const OpenFile& file,
                                     const ImageFileOptions& options);

  BandWriter(BandWriter&& other) noexcept;
  BandWriter& operator=(BandWriter&& other) noexcept;
  ~BandWriter();

  /// Takes the next rows: a picture of the form's width, with alpha if the form has it, and its
  /// channels in the form's order. An error for another picture.
  Status put(const Image& band, const std::vector<ImageChannel>& channels = {});

  /// Checks the file and gives it its name. An error if rows are missing.
  Status finish();

 private:
  struct State;
  explicit BandWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;  ///< null after a move
};

}  // namespace boule
