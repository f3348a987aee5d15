// Several clients of one server of boule view.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace boule::test
