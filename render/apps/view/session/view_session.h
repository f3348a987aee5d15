#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "render/apps/view/messages/view_settings.h"
#include "render/apps/view/session/pane_stage.h"
#include "render/apps/view/session/scene_source.h"

namespace boule {
class Threads;
}

namespace boule::view {

class Audience;
class PictureStore;

/// How a session begins.
struct SessionSettings {
  ViewSettings view;
  WorkSettings work;
  std::string token;  ///< for the addresses of saved pictures
  /// A picture that is saved waits so long for a client that has gone: one whose connection was
  /// lost is back sooner.
  std::chrono::milliseconds longest_absence{10000};
};

/// What its clients see and change, all of them the same picture by the same camera: it takes
/// messages as texts, and each client has an outbox. It renders on a thread of its own, and only
/// while a client is there. What the clients chose stays for the next one.
class ViewSession {
 public:
  /// `loaded` is what `source` has loaded, with the look and the frame of its facts; the source
  /// must outlive the session. `notify` is called, on any thread, when there may be something to
  /// send. An error if the scene cannot be prepared.
  static Result<std::unique_ptr<ViewSession>> open(SceneSource& source, LoadedScene loaded,
                                                   SessionSettings settings,
                                                   std::function<void()> notify);
  ~ViewSession();
  ViewSession(const ViewSession&) = delete;
  ViewSession& operator=(const ViewSession&) = delete;

  /// A client has come: its number. Or it has gone.
  int connect();
  void disconnect(int client);

  /// A message of a client: any bytes.
  void receive(int client, std::string_view message);

  const Audience& audience();
  const PictureStore& pictures();

 private:
  struct Parts;

  explicit ViewSession(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
  std::unique_ptr<Threads> thread_;
};

}  // namespace boule::view
