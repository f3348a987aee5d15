#pragma once

#include <chrono>
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

  friend bool operator==(const Asker&, const Asker&) = default;
};

/// Renders the picture that a client saves, beside those that it sees: one at a time. It belongs to
/// that client. Once the client has gone it waits for it to come again, and ends if that does not
/// happen. The audience and the store must outlive it.
class PictureSaver {
 public:
  using Clock = std::chrono::steady_clock;

  /// Saved pictures have this name; the token opens their address. A picture waits so long for a
  /// client that has gone.
  PictureSaver(Audience& audience, PictureStore& pictures, std::string name, std::string token,
               std::chrono::milliseconds longest_absence)
      : audience_(audience),
        pictures_(pictures),
        name_(std::move(name)),
        token_(std::move(token)),
        longest_absence_(longest_absence) {}

  [[nodiscard]] bool is_busy() const { return job_.has_value(); }
  /// When there is something to do for it; the latest possible time if there is nothing.
  [[nodiscard]] Clock::time_point next_time(Clock::time_point now) const;
  /// Begins one. Precondition: it is not busy.
  void begin(Asker asker, Scene scene, const RenderOptions& options);
  /// Goes on with it for a moment, if its client is there; once it is whole it is kept, brightened
  /// by so many stops.
  void step(float stops);
  /// A client that asks for the same as one that has gone is that one again: it has the picture
  /// from now on. An error goes to any other. Precondition: it is busy.
  void take_over(Asker asker);
  /// Ends it if its client has been away for long.
  void give_up_absent(Clock::time_point now);
  /// Its client no longer wants it. An error goes to any other.
  void stop(Asker asker);
  /// It cannot go on.
  void fail(const Diagnostic& error);
  /// Keeps a picture and tells where it is.
  void keep(const Image& image, float stops, Asker asker);
  void refuse(const Diagnostic& error, Asker asker);

 private:
  [[nodiscard]] bool is_client_here() const { return audience_.outbox(asker_.client) != nullptr; }

  Audience& audience_;
  PictureStore& pictures_;
  const std::string name_, token_;
  const std::chrono::milliseconds longest_absence_;
  std::optional<SaveJob> job_;
  Asker asker_;                                    ///< of the job
  std::optional<Clock::time_point> absent_since_;  ///< its client
};

}  // namespace boule::view
