// Several clients of one server of boule view.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "render/image/encode_image.h"
#include "tests/render/apps/view/view_server.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

using Json = ViewClient::Json;

Scene small_scene() {
  Scene scene = mixed_scene(32, 24);
  scene.image.spp = 2;
  return scene;
}

TEST(WebClients, AllClientsSeeOneCamera) {
  const Scene scene = small_scene();
  RunningServer server(scene);
  std::vector<std::unique_ptr<ViewClient>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<ViewClient>(server.place()));
    ASSERT_FALSE(clients.back()->wait_for("state").is_null());
  }
  for (std::uint32_t mover = 0; mover < 3; ++mover) {
    const double fov = 30 + 10.0 * mover;
    const std::uint32_t number = mover + 1;
    clients[mover]->send({{"type", "camera"}, {"number", number}, {"camera", {{"fov", fov}}}});
    Scene moved = scene;
    moved.camera = pinhole({0.5F, 1.6F, 6}, {0, 0.8F, 0}, static_cast<float>(fov));
    const std::string expected = encode_image(render(moved), StreamFormat::png, "test").value();
    for (const auto& client : clients) {
      Json camera;
      while (camera.is_null() || camera["number"] != number) camera = client->wait_for("camera");
      EXPECT_EQ(camera["camera"]["fov"], fov);
      EXPECT_EQ(client->wait_for_frame(0, number, true)->picture, expected);
    }
  }
  clients[1]->send({{"type", "settings"}, {"number", 4}, {"spp", 3}});
  for (const auto& client : clients) EXPECT_EQ(client->wait_for("state")["settings"]["spp"], 3);
}

TEST(WebClients, AnswersGoToWhoAsked) {
  RunningServer server(small_scene());
  ViewClient one(server.place()), other(server.place());
  one.send({{"type", "texts"}, {"id", 5}});
  EXPECT_EQ(one.wait_for("texts")["id"], 5);
  one.send({{"type", "pick"}, {"id", 6}, {"x", 5}, {"y", 5}});
  EXPECT_EQ(one.wait_for("picked")["id"], 6);
  one.send({{"type", "save"}, {"id", 7}, {"format", "png"}});
  EXPECT_EQ(one.wait_for("saved")["id"], 7);
  one.send_text("{");
  EXPECT_FALSE(one.wait_for("error").is_null());
  other.send({{"type", "settings"}, {"number", 1}, {"spp", 2}});
  for (Json state; state.is_null() || state["number"] != 1;) {
    const auto message = other.next();
    ASSERT_TRUE(message);
    if (!message->json) continue;
    const std::string type = (*message->json)["type"];
    if (type == "state") state = *message->json;
    EXPECT_TRUE(type == "state" || type == "statistics") << type;
  }
}

TEST(WebClients, ALostClientLeavesTheOthersAlone) {
  RunningServer server(small_scene(), 60);
  ViewClient stays(server.place());
  for (std::uint32_t i = 1; i <= 5; ++i) {
    ViewClient goes(server.place());
    goes.send({{"type", "camera"}, {"number", i}, {"moving", true}, {"camera", {{"fov", 30 + i}}}});
    goes.drop();
    stays.send({{"type", "camera"}, {"number", 100 + i}, {"camera", {{"fov", 50 + i}}}});
    EXPECT_TRUE(stays.wait_for_frame(0, 100 + i, true));
  }
}

TEST(WebClients, ChoicesStayForTheNextClient) {
  RunningServer server(small_scene());
  {
    ViewClient client(server.place());
    client.send({{"type", "camera"}, {"number", 1}, {"camera", {{"fov", 33}}}});
    ASSERT_TRUE(client.wait_for_frame(0, 1, false));
    client.drop();
  }
  ViewClient client(server.place());
  EXPECT_EQ(client.wait_for("state")["camera"]["fov"], 33.0);
}

TEST(WebClients, AClientThatReadsNothingStopsNobody) {
  RunningServer server(small_scene());
  const ServerPlace place = server.place();
  std::vector<std::unique_ptr<ViewClient>> sleepers;
  for (int i = 0; i < 10; ++i) {
    sleepers.push_back(std::make_unique<ViewClient>(place));
    for (int k = 0; k < 50; ++k) {
      sleepers.back()->send({{"type", "pick"}, {"id", k}, {"x", 5}, {"y", 5}});
      sleepers.back()->send(
          {{"type", "camera"}, {"number", k}, {"moving", true}, {"camera", {{"fov", 30 + k}}}});
    }
  }
  ViewClient client(place);
  client.send({{"type", "camera"}, {"number", 1000}, {"camera", {{"fov", 50}}}});
  EXPECT_TRUE(client.wait_for_frame(0, 1000, true));
}

/// Whatever number a client has sent, others have a next one.
TEST(WebClients, NumbersGoRound) {
  RunningServer server(small_scene());
  ViewClient greedy(server.place()), other(server.place());
  for (const std::uint32_t number : {2147483647U, 4294967294U, 4294967295U}) {
    greedy.send({{"type", "settings"}, {"number", number}, {"spp", 2}});
    Json state;
    while (state.is_null() || state["number"] != number) state = other.wait_for("state");
  }
  other.send({{"type", "camera"}, {"number", 0}, {"camera", {{"fov", 50}}}});
  const auto frame = other.wait_for_frame(0, 0, true);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->header.number, 0U);
  EXPECT_TRUE(greedy.wait_for_frame(0, 0, true));
}

/// Of a picture that takes longer than any of these tests.
Json long_save(std::uint32_t id) {
  return {{"type", "save"}, {"id", id}, {"format", "png"}, {"spp", 65536}};
}

Scene slow_scene() {
  Scene scene = mixed_scene(1024, 1024);
  scene.image.spp = 1;
  return scene;
}

TEST(WebClients, OnlyItsClientStopsASave) {
  RunningServer server(slow_scene());
  ViewClient owner(server.place()), other(server.place());
  owner.send(long_save(7));
  ASSERT_EQ(owner.wait_for("saving")["id"], 7);
  other.send({{"type", "stop_saving"}, {"id", 7}});
  EXPECT_EQ(other.wait_for("error")["about"], "stop_saving");
  other.send(long_save(7));
  EXPECT_THAT(other.wait_for("error")["text"], testing::HasSubstr("another page is saving"));
  owner.send(long_save(7));  // it is that one already: no error
  owner.send({{"type", "stop_saving"}, {"id", 6}});
  EXPECT_EQ(owner.wait_for("error")["id"], 6);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(owner.wait_for("saving")["id"], 7);
  owner.send({{"type", "stop_saving"}, {"id", 7}});
  const Json stopped = owner.wait_for("error");
  EXPECT_EQ(stopped["about"], "save");
  EXPECT_EQ(stopped["id"], 7);
  EXPECT_EQ(stopped["text"], "stopped");
  other.send(long_save(8));
  EXPECT_EQ(other.wait_for("saving")["id"], 8);
}

/// The save and its end arrive together.
TEST(WebClients, AWaitingSaveCanBeStopped) {
  RunningServer server(slow_scene());
  ViewClient client(server.place());
  for (std::uint32_t id = 1; id < 20; ++id) {
    client.send(long_save(id));
    client.send({{"type", "stop_saving"}, {"id", id}});
    const Json stopped = client.wait_for("error");
    EXPECT_EQ(stopped["about"], "save");
    EXPECT_EQ(stopped["id"], id);
  }
}

TEST(WebClients, AClientFindsItsSaveAgain) {
  RunningServer server(slow_scene(), 60, std::chrono::minutes(1));
  double share = 0;
  {
    ViewClient lost(server.place());
    lost.send(long_save(7));
    while (!(share > 0)) share = lost.wait_for("saving")["share"];
    lost.drop();
  }
  ViewClient again(server.place());
  again.send(long_save(7));
  EXPECT_GE(again.wait_for("saving")["share"], share);
  again.send({{"type", "stop_saving"}, {"id", 7}});
  EXPECT_EQ(again.wait_for("error")["about"], "save");
}

TEST(WebClients, ASaveEndsWithItsClient) {
  RunningServer server(slow_scene(), {}, std::chrono::milliseconds(1));
  ViewClient other(server.place());
  {
    ViewClient lost(server.place());
    lost.send(long_save(7));
    ASSERT_FALSE(lost.wait_for("saving").is_null());
    lost.drop();
  }
  std::string type = "error";
  for (std::uint32_t id = 8; type == "error"; ++id) {
    other.send(long_save(id));
    do {
      const auto message = other.next();
      ASSERT_TRUE(message);
      type = message->json ? std::string((*message->json)["type"]) : "";
    } while (type != "error" && type != "saving");
  }
}

}  // namespace
}  // namespace boule::test
