#pragma once

#include <cstddef>
#include <string>

#include "core/base/error.h"
#include "render/files/particle_file/bridge/child_process.h"
#include "render/files/particle_file/frame/particle_reader.h"

namespace boule {

/// The first answer of boule-read (bridge/boule_read.py).
struct BridgeHead {
  std::string library;  ///< and its version: "ASE 3.22.1"
  std::size_t frames = 0;
};

/// An answer, and whether another request can follow one that is an error.
template <class T>
struct BridgeAnswer {
  Result<T> value;
  bool goes_on = false;
};

/// The first answer. Errors are those of the library, or say what is wrong with the answer.
Result<BridgeHead> read_head(ChildProcess& process);

/// The answer to the request of a frame: all of it, checked; the particles of a file without
/// positions are at 0 if options.places_matter is false, else they are an error. What it promises
/// is refused before memory is taken if it is more than there is.
BridgeAnswer<ParticleFrame> read_frame(ChildProcess& process, const ParticleFileOptions& options);

}  // namespace boule
