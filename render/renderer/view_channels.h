#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/frame/pixel_rect.h"
#include "render/image/image_file.h"
#include "render/integrators/views.h"

namespace boule {

/// Which views are wanted. The channels of each: depth Z, normal N.X N.Y N.Z, position P.X P.Y P.Z,
/// id id (uint32), albedo albedo.R albedo.G albedo.B, z view.Z.
struct ViewSelection {
  bool depth = false, normal = false, position = false, id = false, albedo = false, z = false;

  [[nodiscard]] bool any() const { return depth || normal || position || id || albedo || z; }
};

/// The wanted views of every pixel of a picture, each number in a channel of its own. Two threads
/// may set different pixels at the same time.
class ViewChannels {
 public:
  /// For the frame's pixels in `rect`, not empty. Throws std::bad_alloc.
  ViewChannels(const ViewSelection& selection, const PixelRect& rect);

  /// Stores the view of pixel (x, y) of the frame, which lies in `rect`, before release():
  /// preconditions.
  void set(int x, int y, const View& view);

  /// Gives the channels away, in the order of ViewSelection; nothing is left.
  std::vector<ImageChannel> release();

  /// The names of the channels, in the order of ViewSelection. Throws std::bad_alloc.
  static std::vector<std::string> names(const ViewSelection& selection);

  /// Bytes that the views of so many pixels take.
  static std::uint64_t bytes(const ViewSelection& selection, const PixelRect& rect);

 private:
  PixelRect rect_;
  std::vector<std::size_t> kinds_;  ///< by channel: which number of a view it holds
  std::vector<ImageChannel> channels_;
};

}  // namespace boule
