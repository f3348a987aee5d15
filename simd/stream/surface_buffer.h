#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/shading.h"
#include "simd/stream/aligned_array.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Memory for a SurfaceStream, reused from call to call. Growing loses the contents.
struct SurfaceBuffer {
  VectorBuffer point, normal, view, mirrored, org;
  AlignedArray<double> cosine, reach;
  AlignedArray<std::uint8_t> inner, inside;

  SurfaceBuffer() = default;
  explicit SurfaceBuffer(std::size_t size) { resize(size); }

  void resize(std::size_t size) {
    for (VectorBuffer* vectors : {&point, &normal, &view, &mirrored, &org}) vectors->resize(size);
    cosine.resize(size);
    reach.resize(size);
    inner.resize(size);
    inside.resize(size);
  }
  /// The view for the kernels; valid until the next resize.
  SurfaceStream stream() {
    return {point.view(),  normal.view(), view.view(),  mirrored.view(), org.view(),
            cosine.data(), reach.data(),  inner.data(), inside.data()};
  }
};

}  // namespace boule
