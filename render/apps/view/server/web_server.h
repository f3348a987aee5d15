#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/error.h"

namespace boule::view {

class ViewSession;

inline constexpr unsigned short default_tunnel_port = 8000;

/// How the page is served.
struct ServerSettings {
  std::string address = "127.0.0.1";  ///< a number
  unsigned short port = 0;            ///< 0: one that is free
  /// In place of both, the path of a socket in the file system; `port` is then the one that a
  /// tunnel has at its near end, 0: default_tunnel_port.
  std::string socket;
  std::string token;
  bool embed = false;                      ///< pages of others may show the page in a frame
  std::optional<double> idle_seconds;      ///< ends when no client was there for so long
  std::function<bool()> stop;              ///< asked often: true ends it
  std::function<void(std::string)> ready;  ///< told the URL once it can be opened
};

/// Whether this build has a server (Boost.Beast).
bool has_web_server();

/// Serves the page, and one session to all clients over WebSockets (docs/view_protocol.md). A
/// server is made first, so that the session can call notify() when there is something to send.
class WebServer {
 public:
  WebServer();
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// There may be something to send. Any thread may call it, at any time.
  void notify();

  /// Serves until it is stopped or idle, on the caller's thread. An error if it cannot listen, or
  /// if this build has no server.
  Status serve(const ServerSettings& settings, ViewSession& session);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace boule::view
