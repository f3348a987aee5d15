#pragma once

#include <string>

#include "render/apps/view/messages/frame_message.h"
#include "render/apps/view/panes/jpeg.h"
#include "render/apps/view/session/audience.h"
#include "render/image/image.h"

namespace boule::view {

/// Makes frames of pictures and gives them to the audience. One thread uses it.
class PictureSender {
 public:
  explicit PictureSender(Audience& audience) : audience_(audience) {}

  /// Sends a picture that will change: as JPEG, or as PNG where there is none.
  void send(const Image& image, FrameHeader header, float exposure_stops);
  /// Sends a picture as it is saved: PNG. False where it cannot be made.
  bool send_finished(const Image& image, FrameHeader header, float exposure_stops);

 private:
  Audience& audience_;
  JpegEncoder jpeg_;
};

/// A picture as boule render writes it; empty where it cannot be made.
std::string png_of(const Image& image, float exposure_stops);

}  // namespace boule::view
