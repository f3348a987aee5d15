#include "render/apps/view/server/outer_address.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace boule::view {
namespace {

/// The number of this end of a connection, for datagrams none of which is sent; empty without one.
template <class Place>
std::string number_of_this_end(const Place& there, int family, const void* number, Place& here) {
  const int socket = ::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return {};
  socklen_t size = sizeof here;
  const bool is_known =
      ::connect(socket, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0 &&
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  ::close(socket);
  char text[INET6_ADDRSTRLEN] = "";
  return is_known && ::inet_ntop(family, number, text, sizeof text) != nullptr ? text : "";
}

}  // namespace

/// The receivers are addresses of documentation.
std::string outer_address(bool is_v6) {
  constexpr in_port_t port = 9;
  std::string found;
  if (is_v6) {
    sockaddr_in6 there{}, here{};
    there.sin6_family = AF_INET6;
    there.sin6_port = htons(port);
    ::inet_pton(AF_INET6, "2001:db8::1", &there.sin6_addr);
    found = number_of_this_end(there, AF_INET6, &here.sin6_addr, here);
  } else {
    sockaddr_in there{}, here{};
    there.sin_family = AF_INET;
    there.sin_port = htons(port);
    ::inet_pton(AF_INET, "192.0.2.1", &there.sin_addr);
    found = number_of_this_end(there, AF_INET, &here.sin_addr, here);
  }
  if (!found.empty()) return found;
  return is_v6 ? "::1" : "127.0.0.1";
}

}  // namespace boule::view
