#pragma once

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

class Outbox;
class PictureStore;

/// How a session begins.
struct SessionSettings {
  ViewSettings view;
  WorkSettings work;
  std::string token;  ///< for the addresses of saved pictures
};

/// What one client at a time sees and changes: it takes messages as texts and has an outbox. It
/// renders on a thread of its own, and only while a client is there. What a client chose stays for
/// the next one.
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

  /// A client has come, in place of the one before, or has gone.
  void connect();
  void disconnect();

  /// A message of the client: any bytes.
  void receive(std::string_view message);

  Outbox& outbox();
  const PictureStore& pictures();

 private:
  struct Parts;

  explicit ViewSession(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
  std::unique_ptr<Threads> thread_;
};

}  // namespace boule::view
