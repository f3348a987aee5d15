#pragma once

#include "core/scene/light.h"
#include "simd/abi/isa.h"
#include "simd/abi/shading.h"
#include "simd/abi/whitted.h"

namespace boule {

/// What shadow rays of many points to a light go to.
ShadowTarget shadow_target(const Light& light);

/// What arrives at points along them. A sphere light is a point at its centre here, with radiance
/// (radius / distance)^2: what a surface receives that sees all of it.
LightIntensity light_intensity(const Light& light);

/// What a light's shadow rays have in common.
Coherence shadow_coherence(const Light& light);

}  // namespace boule
