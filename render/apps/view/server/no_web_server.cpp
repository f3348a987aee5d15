#include "render/apps/view/server/web_server.h"

/// In place of web_server.cpp where there is no Boost.Beast.
namespace boule::view {

class WebServer::Implementation {};

bool has_web_server() { return false; }
WebServer::WebServer() = default;
WebServer::~WebServer() = default;
void WebServer::notify() {}
Status WebServer::serve(const ServerSettings&, ViewSession&) {
  return Diagnostic::of("this build has no server: it was made without Boost.Beast");
}

}  // namespace boule::view
