#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "render/apps/view/panes/save_job.h"
#include "render/apps/view/session/audience.h"
#include "render/apps/view/session/picture_store.h"

namespace boule::view {

/// Who waits for an answer: a client, and the id of its message.
struct Asker {
  int client = 0;
  std::uint32_t id = 0;
};

/// Renders the picture that a client saves, beside those that it sees: one at a time. The audience
/// and the store must outlive it.
class PictureSaver {
 public:
  /// Saved pictures have this name; the token opens their address.
  PictureSaver(Audience& audience, PictureStore& pictures, std::string name, std::string token)
      : audience_(audience),
        pictures_(pictures),
        name_(std::move(name)),
        token_(std::move(token)) {}

  [[nodiscard]] bool is_busy() const { return job_.has_value(); }
  /// Begins one. Precondition: it is not busy.
  void begin(Asker asker, Scene scene, const RenderOptions& options);
  /// Goes on with it for a moment; once it is whole it is kept, brightened by so many stops.
  void step(float stops);
  /// The client no longer wants it.
  void stop();
  /// It is not told: another failure is.
  void drop() { job_.reset(); }
  /// Keeps a picture and tells where it is.
  void keep(const Image& image, float stops, Asker asker);
  void refuse(const Diagnostic& error, Asker asker);

 private:
  Audience& audience_;
  PictureStore& pictures_;
  const std::string name_, token_;
  std::optional<SaveJob> job_;
  Asker asker_;  ///< of the job
};

}  // namespace boule::view
