// Data files that mean harm, or went through bad hands: arrays, lenses, pictures, rays.
#include <limits>

#include "tests/render/apps/cli/faults/hostile_files.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

const std::string sixteen_bytes = "0123456789abcdef";

/// A row of float32 numbers.
std::string row(const std::vector<float>& numbers) {
  std::string bytes;
  for (const float x : numbers) append_bytes(bytes, x);
  return bytes;
}

/// An array, well made but for what its header says and holds.
std::function<std::string()> array(const std::string& shape,
                                   const std::string& data = sixteen_bytes,
                                   const std::string& descr = "'<f4'") {
  return just(npy_file(npy_dict(descr, shape), data));
}

std::string whole_array() { return npy_file(npy_dict("'<f4'", "(1, 4)"), row({0, 0, 0, 1})); }

}  // namespace

std::vector<HostileData> hostile_arrays() {
  const char* const d = "d.npy";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::string good = whole_array();
  return {
      {"Empty", d, just(""), "it does not begin with"},
      {"Binary", d, binary, "it does not begin with"},
      {"Text", d, just("1 2 3 4\n"), "it does not begin with"},
      {"Utf16", d, [] { return utf16("NUMPY"); }, "it does not begin with"},
      {"EndsInItsMark", d, just(good.substr(0, 5)), "it does not begin with"},
      {"EndsInItsStart", d, just(good.substr(0, 9)), "it ends within its header"},
      {"EndsInItsHeader", d, just(good.substr(0, 60)), "it ends within its header"},
      {"EndsInItsData", d, just(good.substr(0, good.size() - 1)), "but holds 15 bytes"},
      {"BytesBehind", d, just(good + "x"), "but holds 17 bytes"},
      {"NulInItsHeader", d,
       just(npy_file(std::string("{'descr': '<f4\0', 'fortran_order': False, 'shape': (0, 4)}", 58),
                     "")),
       "holds '<f4\\x00'"},
      {"HeaderBeyond32", d, just(std::string("\x93NUMPY\x02\0\xff\xff\xff\xff{", 13)),
       "it ends within its header"},
      {"LongHeader", d, [] { return npy_file(std::string(16 * mebibyte, '('), "", 2); },
       "longer than 65536"},
      {"Brackets", d, [] { return npy_file("{'descr': " + std::string(60'000, '['), ""); },
       "unexpected value"},
      {"DeepShape", d, array(std::string(60'000, '(')), "unexpected value"},
      {"HugeCount", d, array("(4000000000, 4)"), "declares 4000000000 rows"},
      {"CountThatWraps32", d, array("(4294967297, 4)"), "declares 4294967297 rows"},
      {"CountThatWraps64", d, array("(1152921504606846977, 4)"),
       "declares 1152921504606846977 rows"},
      {"CountBeyond64", d, array("(18446744073709551617, 4)"), "unexpected value"},
      {"CountBelowZero", d, array("(-1, 4)"), "unexpected value"},
      {"ColumnsThatWrap32", d, array("(1, 4294967300)"), "has shape (1, 4294967300)"},
      {"Integers", d, array("(1, 4)", sixteen_bytes, "'<i4'"), "holds '<i4', expected '<f4'"},
      {"Objects", d, array("(1, 4)", sixteen_bytes, "'|O'"), "holds '|O', expected '<f4'"},
      {"HighFirst", d, array("(1, 4)", sixteen_bytes, "'>f4'"), "holds '>f4', expected '<f4'"},
      {"OneDimension", d, array("(4,)"), "has shape (4)"},
      {"ThreeDimensions", d, array("(1, 1, 4)"), "has shape (1, 1, 4)"},
      {"ThreeColumns", d, array("(1, 3)", row({0, 0, 0})), "the key 'radius' is missing"},
      {"FiveColumns", d, array("(1, 5)", row({0, 0, 0, 1, 1})), "has shape (1, 5)"},
      {"UnknownKey", d, just(npy_file("{'desc': '<f4'}", "")), "unknown header key 'desc'"},
      {"KeyTwice", d, just(npy_file("{'descr': '<f4', 'descr': '<f4'}", "")), "given twice"},
      {"Nan", d, array("(2, 4)", row({0, 0, 0, 1, nan, 0, 0, 1})), "row 1: center must be finite"},
      {"Inf", d, array("(1, 4)", row({0, 0, 0, inf})), "row 0: radius must be finite"},
  };
}

std::vector<HostileData> hostile_lenses_and_pictures() {
  const char* const l = "d.lens";
  return {
      {"LensEmpty", l, just(""), ""},
      {"LensBinary", l, binary, "line 1: "},
      {"LensUtf16", l, [] { return utf16("1 1 1 1\n"); }, "line 1:1: is UTF-16 text"},
      {"LensNul", l, just(std::string("1 1\0 1 1\n", 9)), "line 1:4: holds a NUL"},
      {"LensLongLine", l, [] { return repeated("1 ", 16 * mebibyte); }, "line 1: "},
      {"LensManyElements", l, [] { return repeated("1 1 1 1\n", 4 * mebibyte); },
       "must gather light"},
      {"LensNan", l, just("30 4 1.5 20\nnan 0 1 20\n"),
       "line 2: surface 2: its radius must be finite, is nan"},
      {"LensBeyondDouble", l, just("30 4 1.5 20\n1e999 0 1 20\n"), "line 2: "},
      {"LensOfThreeNumbers", l, just("30 4 1.5\n"), "line 1: expected four numbers"},
      {"LensOfFiveNumbers", l, just("30 4 1.5 20 1\n"), "line 1: expected four numbers"},
      {"LensOfWords", l, just("radius 4 1.5 20\n"), "line 1: expected four numbers"},
      {"PictureEmpty", "d.exr", just(""), "cannot read it: "},
      {"PictureNul", "d.png", [] { return std::string(mebibyte, '\0'); }, "cannot read it: "},
      {"PictureUtf16", "d.hdr", [] { return utf16("#?RADIANCE\n"); }, "cannot read it: "},
      {"ExrBinary", "d.exr", binary, "cannot read it: "},
      {"PngBinary", "d.png", binary, "cannot read it: "},
      {"JpegBinary", "d.jpg", binary, "cannot read it: "},
      {"TiffBinary", "d.tif", binary, "cannot read it: "},
      {"BmpBinary", "d.bmp", binary, "cannot read it: "},
      {"HdrBinary", "d.hdr", binary, "cannot read it: "},
      {"PictureWithoutPixels", "d.ppm", just("P6 65535 65535 255\n"), "cannot read it: "},
      {"PictureBeyond32", "d.ppm", just("P6 4294967297 1 255\n123"), "cannot read it: "},
      {"PngEndsInItsHeader", "d.png", just(std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0", 18)),
       "the file ends within the picture"},
      {"PngHugeChunk", "d.png", just(std::string("\x89PNG\r\n\x1a\n\xff\xff\xff\xffIHDR\0\0", 18)),
       "the file ends within the picture"},
      {"HdrHuge", "d.hdr",
       just("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 65535 +X 65535\n\2\2\xff\xff"),
       "cannot read it: "},
      {"ExrHugeAttribute", "d.exr",
       just(std::string("\x76\x2f\x31\x01\x02\0\0\0text\0string\0\xff\xff\xff\x3fx", 25)),
       "the file ends within the picture"},
  };
}

std::vector<HostileData> hostile_rays() {
  const char* const r = "r.npy";
  const std::string good = npy_file(npy_dict("'<f4'", "(1, 8)"), std::string(32, '\0'));
  return {
      {"Empty", r, just(""), "it does not begin with"},
      {"Binary", r, binary, "it does not begin with"},
      {"Utf16", r, [] { return utf16("NUMPY"); }, "it does not begin with"},
      {"EndsInItsHeader", r, just(good.substr(0, 60)), "it ends within its header"},
      {"EndsInItsData", r, just(good.substr(0, good.size() - 1)), "but holds 31 bytes"},
      {"LongHeader", r, [] { return npy_file(std::string(16 * mebibyte, '('), "", 2); },
       "longer than 65536"},
      {"HugeCount", r, array("(4000000000, 8)"), "declares 4000000000 rows"},
      {"CountThatWraps32", r, array("(4294967297, 8)"), "declares 4294967297 rows"},
      {"CountThatWraps64", r, array("(576460752303423489, 8)"), "declares 576460752303423489 rows"},
      {"FourColumns", r, array("(1, 4)"), "has shape (1, 4), expected (N, 8)"},
      {"Integers", r, array("(1, 8)", std::string(64, '\0'), "'<i8'"), "holds '<i8'"},
      {"HalfDoubles", r, array("(1, 8)", std::string(32, '\0'), "'<f8'"),
       "declares 1 rows of 64 bytes"},
  };
}

}  // namespace boule::test
