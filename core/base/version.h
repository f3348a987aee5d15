#pragma once

namespace boule {

/// The version of this library: "2.0.0".
const char* library_version();

}  // namespace boule
