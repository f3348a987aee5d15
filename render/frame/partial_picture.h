#pragma once

#include "render/frame/film.h"
#include "render/frame/measured_picture.h"
#include "render/frame/pixel_order.h"
#include "render/image/image.h"

namespace boule {

/// A whole picture from a film that does not have all its samples yet. A pixel with samples has
/// their mean. What a pixel without samples has depends on the order in which the picture grows:
/// - progressive: the colour of the coarse pixel whose block it lies in. Coarse pixels are those at
///   multiples of 2, 4, 8 and 16 that have samples; the smallest block counts. Without such a pixel
///   as in order frameless.
/// - frameless: the colour of the nearest pixel with samples; of equally near ones the leftmost, of
///   those the upper one. Black if no pixel has samples.
/// - rows, tiles: black.
Image partial_picture(const Film& film, PixelOrder order, Alpha alpha = Alpha::none);

/// The same, but for the pixels that were measured: those are as they were. Precondition: both are
/// of the same pixels.
Image partial_picture(const Film& film, const MeasuredPicture& measured, PixelOrder order,
                      Alpha alpha);

}  // namespace boule
