// The options of particle files: what is typed and what is answered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "render/apps/cli/options/options.h"
#include "render/apps/job/options/look_values.h"

namespace boule::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Command parse(std::vector<const char*> words) {
  words.insert(words.begin(), "boule");
  return parse_command_line(static_cast<int>(words.size()), words.data());
}

LookOptions look_of(std::vector<const char*> options) {
  options.insert(options.begin(), {"render", "a.xyz", "-o", "a.png"});
  const Command command = parse(options);
  const auto* render = std::get_if<RenderCommand>(&command);
  EXPECT_NE(render, nullptr);
  return render != nullptr ? render->look : LookOptions{};
}

TEST(LookOptions, AreKept) {
  const LookOptions look = look_of({"--look",         "dark",
                                    "--color",        "|v|",
                                    "--map",          "#000000,#ff0000",
                                    "--range",        "-1,2.5",
                                    "--radius",       "vdw",
                                    "--scale",        "0.8",
                                    "--select",       "type == 1 && x > 0",
                                    "--frame",        "-2",
                                    "--input-format", "xyz",
                                    "--columns",      "id,-,x,y,z",
                                    "--water"});
  EXPECT_EQ(look.look, Look::dark);
  EXPECT_EQ(look.color, "|v|");
  EXPECT_EQ(look.map, "#000000,#ff0000");
  EXPECT_EQ(look.range, (std::array{-1.0, 2.5}));
  EXPECT_EQ(look.radius, "vdw");
  EXPECT_EQ(look.scale, 0.8);
  EXPECT_EQ(look.select, "type == 1 && x > 0");
  EXPECT_EQ(look.frame, -2);
  EXPECT_EQ(look.format, "xyz");
  EXPECT_EQ(look.columns, (std::vector<std::string>{"id", "-", "x", "y", "z"}));
  EXPECT_TRUE(look.water);
  EXPECT_FALSE(look.quick);
  EXPECT_THAT(look.first, StartsWith("--"));
}

TEST(LookOptions, OfCamerasAreKept) {
  const LookOptions look = look_of({"--view", "-z", "--up", "0,1,0.5", "--roll", "-15", "--ortho",
                                    "--fov", "30", "--margin", "0.1", "--floor"});
  EXPECT_EQ(look.view, (ViewChoice{Vec3d{0, 0, -1}}));
  EXPECT_EQ(look.up, (Vec3d{0, 1, 0.5}));
  EXPECT_EQ(look.roll, -15);
  EXPECT_TRUE(look.ortho);
  EXPECT_EQ(look.fov, 30);
  EXPECT_EQ(look.margin, 0.1);
  EXPECT_TRUE(look.floor);
}

TEST(LookOptions, OfKindsAndCellsAreKept) {
  const LookOptions look =
      look_of({"--colors", "O=crimson,7=#336699,a=b=red", "--radii", "Na=1.02,Cl=1.81",
               "--nan-color", "Silver", "--outline-by", "chain", "--replicate", "2x3x1", "--wrap",
               "--unwrap", "--boundary"});
  EXPECT_EQ(look.colors,
            (std::vector<KindText>{{"O", "crimson"}, {"7", "#336699"}, {"a=b", "red"}}));
  EXPECT_EQ(look.radii, (std::vector<KindText>{{"Na", "1.02"}, {"Cl", "1.81"}}));
  EXPECT_EQ(look.nan_color, "Silver");
  EXPECT_EQ(look.outline_by, "chain");
  EXPECT_EQ(look.replicate, (std::array{2, 3, 1}));
  EXPECT_TRUE(look.wrap);
  EXPECT_TRUE(look.unwrap);
  EXPECT_TRUE(look.boundary);
}

TEST(LookOptions, ClipsKeepWhatTheySay) {
  const auto clips = look_of({"--clip", "x<5; -y >= 2;1,1,0>4"}).clip;
  EXPECT_EQ(clips, (std::vector<ClipChoice>{
                       {{5, 0, 0}, {1, 0, 0}}, {{0, -2, 0}, {0, 1, 0}}, {{2, 2, 0}, {-1, -1, 0}}}));
}

TEST(LookOptions, MapColumnNamesMayHaveBlanks) {
  for (const char* color : {"Velocity Magnitude", "Mean Flow Speed"}) {
    EXPECT_EQ(look_of({"--color", color, "--map", "turbo", "--range", "0,1"}).map, "turbo");
  }
}

TEST(LookOptions, NoneIsGivenByDefault) {
  EXPECT_EQ(look_of({}).first, "");
  EXPECT_EQ(look_of({"--spp", "4"}).first, "");
  EXPECT_EQ(look_of({"--quick"}).first, "--quick");
}

TEST(LookOptions, AllThatAreGivenAreKept) {
  EXPECT_TRUE(look_of({"--spp", "4"}).given.empty());
  const auto given = look_of({"--select", "x > 0", "--floor", "--spp", "4", "--clip", "x<5"}).given;
  EXPECT_THAT(
      given, testing::UnorderedElementsAre(GivenOption{"select", "x > 0"}, GivenOption{"floor", ""},
                                           GivenOption{"clip", "x<5"}));
}

TEST(LookOptions, OfAllCommandsAreTheSame) {
  const Command command = parse({"scene", "a.xyz", "--color", "vz", "--map", "turbo"});
  const auto* scene = std::get_if<SceneCommand>(&command);
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->scene, "a.xyz");
  EXPECT_EQ(scene->look.color, "vz");
  EXPECT_EQ(scene->look.map, "turbo");
  const Command told = parse({"info", "a.xyz", "--frame", "3"});
  const auto* info = std::get_if<InfoCommand>(&told);
  ASSERT_NE(info, nullptr);
  EXPECT_EQ(info->look.frame, 3);
  EXPECT_EQ(info->look.first, "--frame");
}

struct Wrong {
  std::vector<const char*> options;
  std::string text;
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.text; }

class WrongLooks : public testing::TestWithParam<Wrong> {};

TEST_P(WrongLooks, AreRefused) {
  std::vector<const char*> words = {"render", "a.xyz", "-o", "a.png"};
  words.insert(words.end(), GetParam().options.begin(), GetParam().options.end());
  const Command command = parse(words);
  const auto* error = std::get_if<UsageError>(&command);
  ASSERT_NE(error, nullptr);
  EXPECT_THAT(error->text, HasSubstr(GetParam().text));
  EXPECT_EQ(error->help, "boule render --help");
}

const Wrong wrong_looks[] = {
    {{"--look", "pretty"}, "--look: 'pretty' is not understood, expected one of paper|plain|dark"},
    {{"--map", "viridis"}, "--map needs --color COLUMN"},
    {{"--map", "viridis", "--color", "element"}, "--map needs --color COLUMN"},
    {{"--range", "0,1", "--color", "#ffffff"}, "--range needs --color COLUMN"},
    {{"--color", "v", "--map", "rainbow"}, "--map: 'rainbow' is not understood"},
    {{"--color", "v", "--map", "Virdis_r"}, "; did you mean 'viridis_r'?"},
    {{"--color", "v", "--map", "#ffffff,rde"}, "; did you mean 'red'?"},
    {{"--colors", "O=crimsn"}, "; did you mean 'crimson'?"},
    {{"--colors", "O"}, "--colors: 'O' is not understood, expected KIND=COLOR,..."},
    {{"--colors", "=red"}, "--colors: '=red' is not understood"},
    {{"--colors", "O=red,O=blue"}, "each kind once"},
    {{"--radii", "Na=0"}, "--radii: 'Na=0' is not understood"},
    {{"--clip", "x=5"}, "--clip: 'x=5' is not understood, expected what is kept, such as x<5"},
    {{"--clip", "x<5;"}, "--clip: 'x<5;' is not understood"},
    {{"--clip", "0,0,0<5"}, "--clip: '0,0,0<5' is not understood"},
    {{"--clip", "x<nan"}, "--clip: 'x<nan' is not understood"},
    {{"--opacity", "2"}, "--opacity: '2' is not understood, expected a number from 0 to 1"},
    {{"--nan-color", "sliver"}, "; did you mean 'silver'?"},
    {{"--background", "transparant"}, "; did you mean 'transparent'?"},
    {{"--background", "Blakc"}, "; did you mean 'black'?"},
    {{"--look", "papre"}, "; did you mean 'paper'?"},
    {{"--input-format", "xzy"}, "; did you mean 'xyz'?"},
    {{"--replicate", "2x2"}, "--replicate: '2x2' is not understood, expected AxBxC"},
    {{"--replicate", "2x0x2"}, "--replicate: '2x0x2' is not understood"},
    {{"--color", "v", "--range", "1,1"}, "--range: '1,1' is not understood"},
    {{"--color", "v", "--range", "0"}, "--range: '0' is not understood"},
    {{"--color", "v", "--range", "0,inf"}, "--range: '0,inf' is not understood"},
    {{"--color", "#12345"}, "--color: '#12345' is not understood"},
    {{"--radius", "0"}, "--radius: '0' is not understood"},
    {{"--radius", "-1"}, "--radius: '-1' is not understood"},
    {{"--scale", "big"}, "--scale: 'big' is not understood, expected a number above 0"},
    {{"--view", "w"}, "--view: 'w' is not understood"},
    {{"--view", "principle"}, "; did you mean 'principal'?"},
    {{"--roll", "361"}, "--roll: '361' is not understood, expected a number from -360 to 360"},
    {{"--fov", "180"}, "--fov: '180' is not understood"},
    {{"--margin", "0.5"}, "--margin: '0.5' is not understood"},
    {{"--width", "85"}, "--width: '85' is not understood, expected a width in print"},
    {{"--width", "0mm"}, "--width: '0mm' is not understood"},
    {{"--dpi", "0"}, "--dpi: '0' is not understood, expected a number from 1 to 10000"},
    {{"--outline", "101pt"}, "--outline: '101pt' is not understood"},
    {{"--turn", "1"}, "--turn: '1' is not understood"},
    {{"--fps", "0"}, "--fps: '0' is not understood"},
    {{"--view", "0,0,0"}, "--view: '0,0,0' is not understood"},
    {{"--up", "1,2"}, "--up: '1,2' is not understood"},
    {{"--frame", "1.5"}, "--frame: '1.5' is not understood"},
    {{"--input-format", "png"}, "--input-format: 'png' is not understood, expected one of 'npy'"},
    {{"--columns", "x,,z"}, "--columns: 'x,,z' is not understood, expected names such as id,type"},
    {{"--quick", "--look", "dark"}, "excludes"},
    {{"--frame", "1", "--frames", "1-2"}, "excludes"},
};
INSTANTIATE_TEST_SUITE_P(Words, WrongLooks, testing::ValuesIn(wrong_looks));

TEST(LookValues, DirectionsOfAnyLength) {
  EXPECT_EQ(parse_direction("x"), (Vec3d{1, 0, 0}));
  EXPECT_EQ(parse_direction("-y"), (Vec3d{0, -1, 0}));
  EXPECT_EQ(parse_direction("1,-2,0.5"), (Vec3d{1, -2, 0.5}));
  EXPECT_EQ(parse_direction("0,0,1e300"), (Vec3d{0, 0, 1}));
  EXPECT_EQ(parse_direction("iso"), (Vec3d{-1, -1, -1}));
  EXPECT_EQ(parse_view("principal"), (ViewChoice{{}, FittedPose::principal}));
  EXPECT_EQ(parse_view("upright"), (ViewChoice{}));
  EXPECT_EQ(parse_direction("1e-300,0,0"), (Vec3d{1, 0, 0}));
  for (const char* text : {"", "-", "xy", "1,2,nan", "1,2,3,4", "1;2;3", "--x"}) {
    EXPECT_FALSE(parse_direction(text)) << text;
  }
}

}  // namespace
}  // namespace boule::cli
