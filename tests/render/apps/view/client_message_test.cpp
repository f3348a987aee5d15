// Messages of clients: what is understood, and what is refused.
#include "render/apps/view/messages/client_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace boule::view {
namespace {

template <class Message>
Message read(const std::string& text) {
  const auto read = read_message(text);
  if (const auto* refused = std::get_if<RefusedMessage>(&read)) {
    ADD_FAILURE() << text << ": " << refused->error.key << " " << refused->error.message;
    return {};
  }
  return std::get<Message>(std::get<ClientMessage>(read));
}

RefusedMessage refused(const std::string& text) {
  const auto read = read_message(text);
  if (const auto* bad = std::get_if<RefusedMessage>(&read)) return *bad;
  ADD_FAILURE() << text << " was understood";
  return {};
}

TEST(ClientMessage, ReadsCameras) {
  const auto message = read<CameraMessage>(
      R"({"type": "camera", "number": 7, "moving": true, "camera": {"type": "thin_lens",
          "eye": [1, 2.5, -3e2], "fov": 30, "fov_axis": "max", "aperture": 0.1, "focus": null}})");
  EXPECT_EQ(message.number, 7u);
  EXPECT_TRUE(message.moving);
  EXPECT_EQ(message.edit.type, "thin_lens");
  const decltype(message.edit.values) expected{{"eye", Vec3d{1, 2.5, -300}},
                                               {"fov", 30.0},
                                               {"fov_axis", "max"},
                                               {"aperture", 0.1},
                                               {"focus", {}}};
  EXPECT_TRUE(message.edit.values == expected);
}

TEST(ClientMessage, ReadsSettings) {
  const auto message = read<SettingsMessage>(
      R"({"type": "settings", "number": 4294967295, "panes": [{"order": "rows"},
          {"solver": "fast", "method": "path", "shadow_epsilon": "none"}], "difference": "ulp",
          "size": [960, 540], "spp": 4, "max_depth": 0, "exposure": -1.5, "pace": 30000})");
  EXPECT_EQ(message.number, 4294967295u);
  ASSERT_TRUE(message.panes);
  ASSERT_EQ(message.panes->size(), 2u);
  EXPECT_EQ((*message.panes)[0].order, PixelOrder::rows);
  EXPECT_FALSE((*message.panes)[0].shadow_epsilon);
  EXPECT_EQ((*message.panes)[1].solver, Solver::fast);
  ASSERT_TRUE((*message.panes)[1].shadow_epsilon);
  EXPECT_EQ(*(*message.panes)[1].shadow_epsilon, 0.0F);
  EXPECT_EQ(message.difference, Difference::ulp);
  EXPECT_EQ((*message.size)[1], 540);
  EXPECT_EQ(message.spp, 4);
  EXPECT_EQ(message.pace, 30000);
}

TEST(ClientMessage, ReadsTheOthers) {
  EXPECT_EQ(read<AckMessage>(R"({"type": "ack", "frame": 5})").frame, 5u);
  EXPECT_EQ(read<PickMessage>(R"({"type": "pick", "id": 1, "x": 3, "y": 4})").y, 4);
  EXPECT_EQ(read<SaveMessage>(R"({"type": "save", "id": 2, "format": "png", "spp": 9})").spp, 9);
  EXPECT_EQ(read<TextsMessage>(R"({"type": "texts", "id": 3, "pane": 1})").pane, 1);
  EXPECT_EQ(read<FrameMessage>(R"({"type": "frame", "number": 1, "frame": 12})").frame, 12);
  EXPECT_EQ(read<StopSavingMessage>(R"({"type": "stop_saving", "id": 9})").id, 9u);
  const auto particles = read<ParticlesMessage>(
      R"({"type": "particles", "number": 1, "color": "q", "range": [-1, 2]})");
  EXPECT_EQ(particles.color, "q");
  ASSERT_TRUE(particles.range && *particles.range);
  EXPECT_EQ((**particles.range)[1], 2);
  const auto ghosts = read<ParticlesMessage>(
      R"({"type": "particles", "number": 1, "ghost": "q > 1", "opacity": 0.5, "outline_by": "kind"})");
  EXPECT_EQ(ghosts.ghost, "q > 1");
  ASSERT_TRUE(ghosts.opacity && *ghosts.opacity);
  EXPECT_EQ(**ghosts.opacity, 0.5);
  EXPECT_EQ(ghosts.outline_by, "kind");
  const auto any = read<ParticlesMessage>(R"({"type": "particles", "number": 1, "range": null})");
  ASSERT_TRUE(any.range);
  EXPECT_FALSE(*any.range);
}

TEST(ClientMessage, NumbersGoRound) {
  EXPECT_TRUE(is_later(1, 0));
  EXPECT_TRUE(is_later(0, 4294967295));
  EXPECT_TRUE(is_later(2147483647, 0));
  EXPECT_FALSE(is_later(0, 0));
  EXPECT_FALSE(is_later(0, 1));
  EXPECT_FALSE(is_later(4294967295, 0));
}

TEST(ClientMessage, SaysWhatIsWrong) {
  const struct {
    const char* text;
    const char* key;
  } cases[] = {{R"({"type": "jump"})", "type"},
               {R"({"number": 1})", "type"},
               {R"({"type": "camera"})", "number"},
               {R"({"type": "camera", "number": -1})", "number"},
               {R"({"type": "camera", "number": 1.5})", "number"},
               {R"({"type": "camera", "number": 4294967296})", "number"},
               {R"({"type": "camera", "number": 1, "camera": []})", "camera."},
               {R"({"type": "camera", "number": 1, "camera": {"eye": [1, 2]}})", "camera.eye"},
               {R"({"type": "camera", "number": 1, "camera": {"eye": [1, 2, "3"]}})", "camera.eye"},
               {R"({"type": "camera", "number": 1, "camera": {"fov": "wide"}})", "camera.fov"},
               {R"({"type": "camera", "number": 1, "camera": {"fov": null}})", "camera.fov"},
               {R"({"type": "camera", "number": 1, "camera": {"fov_axis": 1}})", "camera.fov_axis"},
               {R"({"type": "camera", "number": 1, "camera": {"roll": 1}})", "camera.roll"},
               {R"({"type": "camera", "number": 1, "camera": {"scale": 1}})", "camera.scale"},
               {R"({"type": "camera", "number": 1, "moving": 1})", "moving"},
               {R"({"type": "settings", "number": 1, "panes": []})", "panes"},
               {R"({"type": "settings", "number": 1, "panes": [{}, {}, {}]})", "panes"},
               {R"({"type": "settings", "number": 1, "panes": [{}, {"order": "spiral"}]})",
                "panes[1].order"},
               {R"({"type": "settings", "number": 1, "panes": [{"shadow_epsilon": -1}]})",
                "panes[0].shadow_epsilon"},
               {R"({"type": "settings", "number": 1, "size": [0, 5]})", "size"},
               {R"({"type": "settings", "number": 1, "size": [5.5, 5]})", "size"},
               {R"({"type": "settings", "number": 1, "size": [100000, 5]})", "size"},
               {R"({"type": "settings", "number": 1, "spp": 0})", "spp"},
               {R"({"type": "settings", "number": 1, "pace": 10})", "pace"},
               {R"({"type": "settings", "number": 1, "exposure": 1e9})", "exposure"},
               {R"({"type": "particles", "number": 1, "range": [2, 1]})", "range"},
               {R"({"type": "pick", "id": 1, "x": -1, "y": 0})", "x"},
               {R"({"type": "pick", "id": 1, "x": 1})", "y"},
               {R"({"type": "save", "id": 1, "format": "exe"})", "format"},
               {R"({"type": "ack"})", "frame"},
               {R"({"type": "ack", "frame": 1, "extra": 2})", "extra"}};
  for (const auto& [text, key] : cases) {
    const RefusedMessage bad = refused(text);
    EXPECT_EQ(bad.error.key, key) << text;
    EXPECT_THAT(bad.error.message, testing::Not(testing::IsEmpty())) << text;
  }
  EXPECT_EQ(refused(R"({"type": "pick", "id": 12, "x": 1})").id, 12u);
  EXPECT_EQ(refused(R"({"type": "pick", "id": 12, "x": 1})").type, "pick");
}

TEST(ClientMessage, TakesAnyBytes) {
  refused("");
  refused("null");
  refused("[]");
  refused("{");
  refused("\xff\xfe");
  refused(std::string("{\"type\": \"ack\"\0}", 16));
  refused(std::string(20'000, ' '));
  refused(std::string(8'000, '[') + std::string(8'000, ']'));
  refused("{\"type\": \"" + std::string(5'000, 'a') + "\"}");
  refused(R"({"type": "ack", "frame": 1e999})");
  refused(R"({"type": "ack", "frame": NaN})");
}

}  // namespace
}  // namespace boule::view
