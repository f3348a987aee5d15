#pragma once

namespace boule {

/// The version of this library: "1.0.0".
const char* library_version();

}  // namespace boule
