#pragma once

#include <optional>
#include <string>

#include "core/base/error.h"

namespace boule {

/// An array in an archive of NumPy's, as scenes name it: "run.npz:positions", or "run.npz" for the
/// only one in it.
struct NpzName {
  std::string file;
  std::string array;  ///< empty: the only one
};

/// Nothing if `path` names no array in an archive.
std::optional<NpzName> npz_name(const std::string& path);

/// The bytes of the array as a .npy file. An error if the archive or the array cannot be read, if
/// the array does not fit into memory, or if the build has no libzip.
Result<std::string> read_npz_array(const NpzName& name);

}  // namespace boule
