#pragma once

#include "render/frame/film.h"
#include "render/frame/pixel_order.h"
#include "render/image/image.h"

namespace boule {

/// A whole picture from a film that has not all its samples yet, whatever the order it grows in.
/// A pixel with samples has their mean. One without has, in order progressive, the colour of the
/// coarse pixel whose block it lies in: the finest of those at multiples of 2, 4, 8, 16 that has
/// samples; else, and in order frameless, that of the nearest pixel with samples (of equally near
/// ones the leftmost, of those the upper one). In orders rows and tiles, and where no pixel has
/// samples, it is black; of an empty film it has no pixels. Throws std::bad_alloc.
Image partial_picture(const Film& film, PixelOrder order);

}  // namespace boule
