#include "render/apps/view/server/listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

#include "render/apps/view/server/outer_address.h"

namespace boule::view {
namespace {

int new_socket(int family, int flags = 0) {
  return ::socket(family, SOCK_STREAM | SOCK_CLOEXEC | flags, 0);
}

Status system_error() { return Diagnostic::of(std::strerror(errno)); }

/// A socket that nobody listens at any more: what a program that was killed has left. One whose
/// program is busy is not: the probe waits for nobody, however many wait there already.
bool is_left_over(const sockaddr_un& place) {
  struct stat found {};
  if (::lstat(place.sun_path, &found) != 0 || !S_ISSOCK(found.st_mode)) return false;
  const int probe = new_socket(AF_UNIX, SOCK_NONBLOCK);
  const bool is_refused =
      ::connect(probe, reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0 &&
      errno == ECONNREFUSED;
  ::close(probe);
  return is_refused;
}

/// Device and number of a file; zeros if there is none.
std::array<std::uint64_t, 2> identity_of(const std::string& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return {};
  return {found.st_dev, found.st_ino};
}

}  // namespace

Listener::Listener(Listener&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      family_(other.family_),
      url_(std::move(other.url_)),
      file_(std::exchange(other.file_, {})),
      identity_(other.identity_) {}

Listener::~Listener() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!file_.empty() && identity_of(file_) == identity_) ::unlink(file_.c_str());
}

int Listener::release() { return std::exchange(descriptor_, -1); }

Status Listener::bind_to(const void* address, unsigned size) const {
  if (descriptor_ < 0) return system_error();
  const int on = 1;
  ::setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(descriptor_, static_cast<const sockaddr*>(address), size) != 0) return system_error();
  return {};
}

/// The address that it is bound to. Nobody can open one that means all of this machine's.
void Listener::name_address() {
  sockaddr_storage own{};
  socklen_t size = sizeof own;
  auto* const address = reinterpret_cast<sockaddr*>(&own);
  ::getsockname(descriptor_, address, &size);
  std::array<char, NI_MAXHOST> host{};
  std::array<char, NI_MAXSERV> port{};
  ::getnameinfo(address, size, host.data(), host.size(), port.data(), port.size(),
                NI_NUMERICHOST | NI_NUMERICSERV);
  std::string name = host.data();
  const bool is_v6 = family_ == AF_INET6;
  if (name == "0.0.0.0" || name == "::") name = outer_address(is_v6);
  url_ = "http://" + (is_v6 ? "[" + name + "]" : name) + ":" + port.data();
}

Result<Listener> Listener::open_file(const ServerSettings& settings) {
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  if (settings.socket.size() >= sizeof place.sun_path)
    return Diagnostic::about("--socket", "its path is too long for a socket");
  std::memcpy(place.sun_path, settings.socket.c_str(), settings.socket.size());
  if (is_left_over(place)) ::unlink(place.sun_path);
  Listener listener(new_socket(AF_UNIX), AF_UNIX);
  // The mode comes before the file, so that nobody else can open it in between.
  const bool is_own = ::fchmod(listener.descriptor_, S_IRUSR | S_IWUSR) == 0;
  auto done = is_own ? listener.bind_to(&place, sizeof place) : system_error();
  if (done) {
    listener.file_ = settings.socket;
    listener.identity_ = identity_of(settings.socket);
    if (::listen(listener.descriptor_, SOMAXCONN) != 0) done = system_error();
  }
  if (!done)
    return Diagnostic::of("cannot listen at " + settings.socket + ": " + done.error().message);
  const int near_port = settings.port > 0 ? settings.port : default_tunnel_port;
  listener.url_ = "http://localhost:" + std::to_string(near_port);
  return listener;
}

Result<Listener> Listener::open(const ServerSettings& settings) {
  if (!settings.socket.empty()) return open_file(settings);
  const std::string port = std::to_string(settings.port);
  addrinfo hints{};
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(settings.address.c_str(), port.c_str(), &hints, &found) != 0)
    return Diagnostic::about("--listen", "expected an address in numbers");
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> place(found, ::freeaddrinfo);
  Listener listener(new_socket(place->ai_family), place->ai_family);
  auto done = listener.bind_to(place->ai_addr, place->ai_addrlen);
  if (done && ::listen(listener.descriptor_, SOMAXCONN) != 0) done = system_error();
  if (!done) {
    return Diagnostic::of("cannot listen on " + settings.address + ", port " + port + ": " +
                          done.error().message);
  }
  listener.name_address();
  return listener;
}

}  // namespace boule::view
