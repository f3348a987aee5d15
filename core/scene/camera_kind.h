#pragma once

#include <cstdint>

namespace boule {

/// How the film point (x, y), each about -1..1, becomes a ray: by the vector p = x right + y up.
enum class CameraKind : std::uint8_t {
  perspective,  ///< from the eye along forward + p
  parallel,     ///< along forward from eye + p
  equidistant,  ///< from the eye, |p| radians from forward towards p; no ray where |p| > pi
  thin_lens,    ///< from eye + o along forward + p - o / focus, o on the lens
  lens,         ///< through the elements of a lens: LensOptics
};

}  // namespace boule
