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

/// What is known of a picture before it has pixels.
struct ImageForm {
  int width = 0;
  int height = 0;
  Alpha alpha = Alpha::none;
  std::vector<ChannelForm> channels{};
};

/// Writes a picture like write_image(), but takes it in bands of rows from the top, so that the
/// whole of it need not be in memory. The file has the same bytes, however high the bands are. A
/// writer that is not finished leaves an old file as it was, and nothing else. Diagnostics are
/// those of write_image(), also for what callbacks throw; after one, no call succeeds. One thread
/// at a time may use it, not always the same one.
class BandWriter {
 public:
  /// Begins the file. Of options.channels nothing is used: `form` says which there are.
  static Result<BandWriter> open(const ImageForm& form, const std::string& path,
                                 const ImageFileOptions& options = {});
  /// The same for a PNG that goes into a file of the caller's, where it is not checked.
  /// options.temporary is not called. What `file` refers to must outlive the writer.
  static Result<BandWriter> open_png(const ImageForm& form, const OpenFile& file,
                                     const ImageFileOptions& options);

  BandWriter(BandWriter&& other) noexcept;
  BandWriter& operator=(BandWriter&& other) noexcept;
  ~BandWriter();

  /// Takes the next rows: a picture of the form's width, with alpha if the form has that, and its
  /// channels in the form's order. An error for another picture.
  Status put(const Image& band, const std::vector<ImageChannel>& channels = {});

  /// Checks the file and gives it its name. An error if there are too few rows yet.
  Status finish();

 private:
  struct State;
  explicit BandWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;  ///< null once it was moved away
};

}  // namespace boule
