#pragma once

#include "core/scene/light.h"
#include "simd/abi/isa.h"
#include "simd/abi/shading.h"
#include "simd/abi/whitted.h"

namespace boule {

/// The target of shadow rays from many points to a light.
ShadowTarget shadow_target(const Light& light);

/// The intensity that arrives at points along these rays. A sphere light is a point at its centre
/// here, with radiance (radius / distance)^2: the light on a surface that sees all of it.
LightIntensity light_intensity(const Light& light);

/// The coherence of a light's shadow rays.
Coherence shadow_coherence(const Light& light);

}  // namespace boule
