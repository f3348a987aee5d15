#pragma once

#include "render/frame/film.h"
#include "render/frame/measured_picture.h"
#include "render/frame/pixel_order.h"
#include "render/image/image.h"

namespace boule {

/// A whole picture from a film that is still without some of its samples. A pixel with samples has
/// their mean. The colour of a pixel without samples depends on the order in which the picture
/// grows:
/// - progressive: the colour of the coarse pixel whose block it lies in. Coarse pixels are those at
///   multiples of 2, 4, 8 and 16 that have samples; the smallest block counts. Without such a
///   pixel, as in order frameless.
/// - frameless: the colour of the nearest pixel with samples; of equally near ones the leftmost, of
///   those the upper one. Black if no pixel has samples.
/// - rows, tiles: black.
Image partial_picture(const Film& film, PixelOrder order, Alpha alpha = Alpha::none);

/// The same, but measured pixels stay as they are. Precondition: both have the same pixels.
Image partial_picture(const Film& film, const MeasuredPicture& measured, PixelOrder order,
                      Alpha alpha);

}  // namespace boule
