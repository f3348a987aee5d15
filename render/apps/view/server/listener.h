#pragma once

#include <string>

#include "core/base/error.h"
#include "render/apps/view/server/web_server.h"

namespace boule::view {

/// A place where a server listens: a port of an address, or a socket in the file system, which only
/// its owner may use, and which goes with this object.
class Listener {
 public:
  /// An error if nobody can listen there.
  static Result<Listener> open(const ServerSettings& settings);
  Listener(Listener&& other) noexcept;
  Listener& operator=(Listener&&) = delete;
  ~Listener();

  /// The descriptor becomes the caller's.
  int release();
  [[nodiscard]] int family() const { return family_; }
  /// The page's address, without its path. Of a socket in the file system: the one that a tunnel by
  /// ssh gives it, at ServerSettings::port.
  [[nodiscard]] const std::string& url() const { return url_; }

 private:
  Listener(int descriptor, int family) : descriptor_(descriptor), family_(family) {}
  Status bind_to(const void* address, unsigned size) const;
  void name_address();

  int descriptor_, family_;
  std::string url_;
  std::string file_;  ///< of a socket in the file system
};

}  // namespace boule::view
