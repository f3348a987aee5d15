#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "core/scene/camera.h"
#include "render/apps/view/messages/client_message.h"
#include "render/apps/view/messages/view_settings.h"
#include "render/apps/view/session/scene_source.h"

namespace boule::view {

/// What the clients want to see. The newest counts.
struct Wish {
  std::uint32_t number = 0;  ///< the latest of a message that has changed it
  Camera camera;
  std::uint32_t camera_revision = 0;  ///< another one where the camera is another
  ViewSettings settings;
  ParticleLook look;
  int frame = 0;
};

/// What has happened since somebody looked.
struct News {
  bool stop = false, connected = false, camera = false, settings = false, scene = false;
  bool camera_type = false;  ///< the camera is of another kind: keys were chosen
  int mover = 0;             ///< the client that moves the camera; 0: it has come to rest
  // Of each client the newest.
  std::map<int, PickMessage> picks;
  std::map<int, SaveMessage> saves;
  std::map<int, StopSavingMessage> stops;
  std::map<int, TextsMessage> texts;

  [[nodiscard]] bool any() const {
    return stop || connected || camera || settings || scene || !picks.empty() || !saves.empty() ||
           !stops.empty() || !texts.empty();
  }
};

/// The clients' wishes on their way to the thread that renders. Wishes are merged, and of each kind
/// of question the newest of a client waits, so that it never grows. Any thread may use it.
class Mailbox {
 public:
  using Clock = std::chrono::steady_clock;

  /// What messages are checked against.
  struct Limits {
    PaneSettings pane;  ///< what a pane has that a message does not tell
    bool particles = false;
    std::optional<FrameSpan> frames;
  };
  Mailbox(Wish first, const Limits& limits) : wish_(std::move(first)), limits_(limits) {}

  /// A message; an error says why it changes nothing.
  Status take(const ClientMessage& message);
  /// A client has come.
  void connect();
  void stop();

  /// Waits for news until that time at most. `wish` becomes the newest one.
  News wait_until(Clock::time_point time, Wish& wish);
  /// Ends a wait: there is something else to do.
  void wake();

  /// Whether the client moves the camera and has not come to rest at that time.
  [[nodiscard]] bool is_moving(Clock::time_point time) const;
  /// When that will have ended if nothing comes.
  [[nodiscard]] Clock::time_point moving_until() const;

  /// Becomes true as soon as what is rendered at rest is not wanted any more. wait_until() lowers
  /// it.
  [[nodiscard]] const std::atomic<bool>& overtaken() const { return overtaken_; }

  /// Takes back what could not be read, or puts the camera where the scene wants it.
  void correct(const Wish& wish);
  /// The scene's origin, in whose coordinates the camera is.
  void set_origin(const Vec3d& origin);

 private:
  void count(std::uint32_t number);
  Status apply(const CameraMessage& message);
  Status apply(const SettingsMessage& message);
  Status apply(const ParticlesMessage& message);
  Status apply(const FrameMessage& message);
  Status apply(const PickMessage& message);
  Status apply(const SaveMessage& message);
  Status apply(const StopSavingMessage& message);
  Status apply(const TextsMessage& message);
  Status apply(const AckMessage& message);
  [[nodiscard]] Status check_pane(int pane) const;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Wish wish_;
  const Limits limits_;
  Vec3d origin_;
  News news_;
  bool woken_ = false;
  Clock::time_point moving_until_{};
  std::atomic<bool> overtaken_{false};
};

}  // namespace boule::view
