#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/error.h"

/// Who may talk to the server. These functions take any bytes.
namespace boule::view {

/// 128 random bits from the system, as 32 hexadecimal digits. An error where it has none to give.
Result<std::string> random_token();

/// Whether two texts are the same, in a time that depends on their lengths only.
bool same_secret(std::string_view a, std::string_view b);

/// Whether the Host of a request is one that a browser only sends to this machine's own address: a
/// number, or localhost, with any port. A name could be that of a stranger's page which leads here
/// (DNS rebinding).
bool is_own_host(std::string_view host);

/// Whether a page with this Origin was served by the server itself, which has this Host.
bool is_own_origin(std::string_view origin, std::string_view host);

/// What a request asks for. Nothing is decoded: what needs decoding is nothing that is served.
struct Target {
  std::string_view path;   ///< "/view.js"
  std::string_view token;  ///< of the query; empty without one
};
Target read_target(std::string_view target);

/// N of "/picture/N", below 2^31; none for anything else.
std::optional<int> picture_number(std::string_view path);

}  // namespace boule::view
