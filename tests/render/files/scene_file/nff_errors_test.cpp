#include "tests/render/files/scene_file/scene_folder.h"

// NFF files that are wrong: each is refused at its line and column, with its key.

namespace boule::nff_errors {
namespace {

using test::Refusal;

class NffErrors : public testing::TestWithParam<Refusal> {};

TEST_P(NffErrors, AreRefusedWithPlaceAndKey) { test::expect_refused(GetParam(), "scene.nff"); }

/// `text` after a view of six lines: it begins on line 7.
std::string scene(const std::string& text) {
  return "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 8 8\n" + text;
}

const Refusal views[] = {
    {"EmptyFile", "", 1, 1, "v", "the scene is empty: the file has no v block"},
    {"OnlyComments", "# a\n\n", 2, 1, "v", "the scene is empty: the file has no v block"},
    {"NoView", "s 0 0 0 1\n", 1, 10, "v", "no v block"},
    {"Second", scene("v\n"), 7, 1, "v", "a second v block"},
    {"NoFrom", "v\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 8 8\n", 1, 1, "v.from", "'from'"},
    {"NoAt", "v\nfrom 0 0 5\nup 0 1 0\nangle 45\nresolution 8 8\n", 1, 1, "v.at", "'at'"},
    {"NoUp", "v\nfrom 0 0 5\nat 0 0 0\nangle 45\nresolution 8 8\n", 1, 1, "v.up", "'up'"},
    {"NoAngle", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nresolution 8 8\n", 1, 1, "v.angle", "'angle'"},
    {"NoResolution", "\nv\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nl 0 0 0\n", 2, 1,
     "v.resolution", "lacks its line 'resolution'"},
    {"MemberTwice", "v\nfrom 0 0 5\nfrom 0 0 5\n", 3, 1, "v.from", "twice, first on line 2"},
    {"MemberOutside", scene("s 0 0 0 1\nangle 45\n"), 8, 1, "angle", "unknown entity 'angle'"},
    {"WordsBehindV", "v 1\n", 1, 3, "v", "expected the end of the line, got '1'"},
    {"AngleZero", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 0\nresolution 8 8\n", 5, 7, "v.angle",
     "above 0 and below 180"},
    {"AngleHalfTurn", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\n  angle  180\nresolution 8 8\n", 5, 10,
     "v.angle", "below 180"},
    {"FromIsAt", "v\nfrom 0 0 5\nat 0 0 5\nup 0 1 0\nangle 45\nresolution 8 8\n", 3, 4, "v.at",
     "must differ from eye"},
    {"UpIsTheView", "v\nfrom 0 0 5\nat 0 0 0\nup 0 0 1\nangle 45\nresolution 8 8\n", 4, 4, "v.up",
     "1e-6 rad"},
    {"ResolutionZero", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 0 8\n", 6, 12,
     "v.resolution", "1 to 65535, is 0"},
    {"ResolutionLarge", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 8 65536\n", 6, 12,
     "v.resolution", "is 65536"},
    {"ResolutionFraction", "v\nresolution 8 8.5\n", 2, 14, "v.resolution",
     "expected an integer of 32 bits, got '8.5'"},
    {"ResolutionHuge", "v\nresolution 8 99999999999\n", 2, 14, "v.resolution", "32 bits"},
    {"ResolutionOne", "v\nresolution 8\n", 2, 13, "v.resolution", "the line ends here"},
    {"FromTwo", "v\nfrom 1 2\n", 2, 9, "v.from", "expected a number, the line ends here"},
    {"FromFour", "v\nfrom 1 2 3 4\n", 2, 12, "v.from", "expected the end of the line"},
    {"HitherText", "v\nhither near\n", 2, 8, "v.hither", "got 'near'"},
};
INSTANTIATE_TEST_SUITE_P(Views, NffErrors, testing::ValuesIn(views), test::refusal_name);

const Refusal entities[] = {
    {"Cone", scene("c\n0 0 0 1\n0 0 1 0.5\n"), 7, 1, "c",
     "cones and cylinders are not read, only left out where polygons are (--polygons skip)"},
    {"Unknown", scene("\n  sphere 0 0 0 1\n"), 8, 3, "sphere", "unknown entity 'sphere'"},
    {"ControlBytes", scene("\x1b[2J\n"), 7, 1, "\\x1b[2J", "'\\x1b[2J'"},
    {"BackgroundTwo", scene("b 0 0\n"), 7, 6, "b.color", "the line ends here"},
    {"BackgroundNegative", scene("b 0 -1 0\n"), 7, 3, "b.color", "0 or above"},
    {"BackgroundTwice", scene("b 0 0 0\nb 0 0 0\n"), 8, 1, "b", "a second background"},
    {"LightOneOfThree", scene("l 1 2 3 0.5\n"), 7, 12, "l.color", "the line ends here"},
    {"LightSeven", scene("l 1 2 3 0.5 0.5 0.5 1\n"), 7, 21, "l", "end of the line"},
    {"LightNegative", scene("l 1 2 3 0.5 0.5 -0.5\n"), 7, 9, "l.color", "0 or above"},
    {"LightTwo", scene("l 1 2\n"), 7, 6, "l.position", "the line ends here"},
    {"FillSeven", scene("f 1 1 1 1 0 0 0\n"), 7, 16, "f.ior", "the line ends here"},
    {"FillNine", scene("f 1 1 1 1 0 0 0 1 0.2\n"), 7, 19, "f", "end of the line, got '0.2'"},
    {"FillColor", scene("f 1 1 -1 1 0 0 0 1\n"), 7, 3, "f.color", "0 or above"},
    {"FillKd", scene("f 1 1 1 -1 0 0 0 1\n"), 7, 9, "f.Kd", "0 or above"},
    {"FillKs", scene("f 1 1 1 1 -1 0 0 1\n"), 7, 11, "f.Ks", "0 or above"},
    {"FillShine", scene("f 1 1 1 1 0 -1 0 1\n"), 7, 13, "f.shine", "0 or above"},
    {"FillT", scene("f 1 1 1 1 0 0 -1 1\n"), 7, 15, "f.T", "0 or above"},
    {"FillIorNegative", scene("f 1 1 1 1 0 0 0 -1\n"), 7, 17, "f.ior", "above 0"},
    {"FillIorZeroOfGlass", scene("f 1 1 1 1 0 0 0.5 0\n"), 7, 19, "f.ior", "above 0"},
};
INSTANTIATE_TEST_SUITE_P(Entities, NffErrors, testing::ValuesIn(entities), test::refusal_name);

const Refusal numbers[] = {
    {"RadiusZero", scene("s 0 0 0 0\n"), 7, 9, "s.radius", "above 0, is 0"},
    {"RadiusNegative", scene("s 0 0 0 -1\n"), 7, 9, "s.radius", "above 0, is -1"},
    {"RadiusUnderflow", scene("s 0 0 0 1e-60\n"), 7, 9, "s.radius", "above 0"},
    {"SphereThree", scene("s 0 0 0\n"), 7, 8, "s.radius", "expected a number, the line ends here"},
    {"SphereFive", scene("s 0 0 0 1 2\n"), 7, 11, "s", "expected the end of the line"},
    {"CommentEndsTheLine", scene("s 0 0 0 # 1\n"), 7, 8, "s.radius", "the line ends here"},
    {"NaN", scene("s 0 nan 0 1\n"), 7, 5, "s.center", "must be finite"},
    {"Inf", scene("s 0 0 -inf 1\n"), 7, 7, "s.center", "must be finite"},
    {"TooLargeForFloat", scene("s 1e39 0 0 1\n"), 7, 3, "s.center", "too large for a 32-bit"},
    {"TooLargeForDouble", scene("s 1e400 0 0 1\n"), 7, 3, "s.center", "too large for a 32-bit"},
    {"LongTooLarge", scene("s " + std::string(400, '9') + "e-20 0 0 1\n"), 7, 3, "s.center",
     "too large for a 32-bit"},
    {"Text", scene("s zero 0 0 1\n"), 7, 3, "s.center", "expected a number, got 'zero'"},
    {"Hexadecimal", scene("s 0x10 0 0 1\n"), 7, 3, "s.center", "got '0x10'"},
    {"HalfExponent", scene("s 1e 0 0 1\n"), 7, 3, "s.center", "got '1e'"},
    {"TwoSigns", scene("s +-1 0 0 1\n"), 7, 3, "s.center", "got '+-1'"},
    {"Comma", scene("s 1,0 0 0 1\n"), 7, 3, "s.center", "got '1,0'"},
};
INSTANTIATE_TEST_SUITE_P(Numbers, NffErrors, testing::ValuesIn(numbers), test::refusal_name);

const Refusal polygons[] = {
    {"NoCount", scene("p\n"), 7, 2, "p", "expected an integer, the line ends here"},
    {"CountTwo", scene("p 2\n0 0 0\n1 0 0\n"), 7, 3, "p", "3 vertices or more, not 2"},
    {"CountNegative", scene("pp -3\n"), 7, 4, "pp", "not -3"},
    {"CountText", scene("p three\n"), 7, 3, "p", "expected an integer of 32 bits, got 'three'"},
    {"CountThatLies", scene("p 2147483647\n0 0 0\n1 0 0\n"), 9, 6, "p",
     "the file ends after 2 of 2147483647 vertices"},
    {"FewVertices", scene("p 4\n0 0 0\n1 0 0\n0 1 0\ns 0 0 0 1\n"), 11, 1, "p", "got 's'"},
    {"VertexTwo", scene("p 3\n0 0\n"), 8, 4, "p", "the line ends here"},
    {"VertexFour", scene("p 3\n0 0 0 0\n"), 8, 7, "p", "end of the line"},
    {"PatchWithoutNormals", scene("pp 3\n0 0 0\n"), 8, 6, "pp", "the line ends here"},
    {"NoArea", scene("p 3\n0 0 0\n1 1 1\n2 2 2\n"), 7, 1, "p", "no area"},
    {"OnePoint", scene("p 3\n1 1 1\n1 1 1\n1 1 1\n"), 7, 1, "p", "no area"},
    {"NoAreaAfterRounding", scene("p 3\n0.1 0.3 0\n0.2 0.6 0\n0.3 0.9 0\n"), 7, 1, "p", "no area"},
    {"NotFlat", scene("p 4\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n"), 7, 1, "p", "not flat"},
};
INSTANTIATE_TEST_SUITE_P(Polygons, NffErrors, testing::ValuesIn(polygons), test::refusal_name);

}  // namespace
}  // namespace boule::nff_errors
