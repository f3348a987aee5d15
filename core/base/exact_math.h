#pragma once

/// Included by one source of each library, which is not compiled where hits would be wrong without
/// a word. core/exact_math.cmake refuses more, where CMake sees the options.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "boule: -ffast-math, -Ofast and -ffinite-math-only make its hits wrong"
#endif
