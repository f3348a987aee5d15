#pragma once

#include <string>

#include "bench/scenes/bench_scenes.h"
#include "core/math/color.h"

namespace boule::bench {

/// One sphereflake as whole scenes that programs read: with floor, lights, colours and background
/// as "balls" of Haines' Standard Procedural Databases has them.

/// make_scene(name) if that is flakeD, the only ones there are whole frames of.
Result<BenchScene> make_flake(const std::string& name);

/// How its floor is written: SPD's square, 24 a side, or the plane in which that lies, which is
/// what Boule makes of it.
enum class Floor { square, plane };

/// In NFF, for Boule.
std::string as_nff(const BenchScene& flake);

/// In Tachyon's own format, for pictures of `side` pixels a side. Mirrored in x, since Tachyon's
/// world is left-handed, and turned by half a pixel, since it samples the pixels' corners.
std::string as_tachyon(const BenchScene& flake, Floor floor, int side, int ray_depth);

/// In POV-Ray's language, the floor as a plane.
std::string as_pov(const BenchScene& flake, int trace_level);

/// The colour that Tachyon adds where its last mirror meets another mirror: the background,
/// weighted by the first mirror alone. Boule and POV-Ray add nothing there.
Color beyond_tachyons_last_mirror();

}  // namespace boule::bench
