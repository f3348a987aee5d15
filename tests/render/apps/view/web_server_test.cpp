// The server of boule view as clients find it, good ones and bad ones.
#include "render/apps/view/server/web_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "render/image/encode_image.h"
#include "tests/render/apps/view/view_server.h"
#include "tests/render/picture_comparison.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Json = ViewClient::Json;

std::uint64_t resident_bytes() {
  std::uint64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

Scene scene_of(int width, int height, int spp) {
  Scene scene = mixed_scene(width, height);
  scene.image.spp = spp;
  return scene;
}

std::string png_of(const Image& image) {
  return encode_image(image, StreamFormat::png, "test").value();
}

std::string get(const ServerPlace& place, const std::string& target, const std::string& host) {
  return http_answer(place, "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
}

TEST(WebServer, ServesThePageAndNothingElse) {
  RunningServer server(scene_of(32, 24, 1));
  const ServerPlace place = server.place();
  const std::string page = get(place, "/?token=" + place.token, place.authority());
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'self'"));
  EXPECT_THAT(page, HasSubstr("Cache-Control: no-store"));
  EXPECT_THAT(page, HasSubstr("Referrer-Policy: no-referrer"));
  EXPECT_THAT(page, HasSubstr("X-Content-Type-Options: nosniff"));
  for (const char* target : {"/", "/?token=", "/?token=wrong", "/picture/1"})
    EXPECT_THAT(get(place, target, place.authority()), StartsWith("HTTP/1.1 403 ")) << target;
  for (const char* target :
       {"/nothing.js", "/../README.md", "/..%2fREADME.md", "//etc/passwd", "/etc/passwd",
        "/page/index.html", "/./index.html", "/index.html/", "/view_loop.cpp", "/socket"})
    EXPECT_THAT(get(place, target, place.authority()), StartsWith("HTTP/1.1 404 ")) << target;
}

TEST(WebServer, RefusesForeignHosts) {
  RunningServer server(scene_of(32, 24, 1));
  const ServerPlace place = server.place();
  for (const char* host : {"evil.example", "127.0.0.1.evil.example", ""})
    EXPECT_THAT(get(place, "/?token=" + place.token, host), StartsWith("HTTP/1.1 421 ")) << host;
  EXPECT_EQ(asked_status(place, {.host = "evil.example"}), 421);
}

TEST(WebServer, RefusesWrongTokensAndForeignOrigins) {
  RunningServer server(scene_of(32, 24, 1));
  const ServerPlace place = server.place();
  EXPECT_EQ(asked_status(place, {.token = ""}), 403);
  EXPECT_EQ(asked_status(place, {.token = std::string(32, 'f')}), 403);
  EXPECT_EQ(asked_status(place, {.origin = "http://evil.example"}), 403);
  EXPECT_EQ(asked_status(place, {.origin = "null"}), 403);
  EXPECT_EQ(asked_status(place, {.origin = ""}), 101);  // no browser
  EXPECT_EQ(asked_status(place), 101);
}

TEST(WebServer, RefusesBrokenRequests) {
  RunningServer server(scene_of(32, 24, 1));
  const ServerPlace place = server.place();
  const std::string host = "\r\nHost: " + place.authority() + "\r\n";
  EXPECT_THAT(http_answer(place, "POST /?token=" + place.token + " HTTP/1.1" + host + "\r\n"),
              StartsWith("HTTP/1.1 405 "));
  EXPECT_THAT(http_answer(place, "HEAD /?token=" + place.token + " HTTP/1.1" + host + "\r\n"),
              StartsWith("HTTP/1.1 200 "));
  http_answer(place, "nonsense\r\n\r\n");
  http_answer(place, "GET / HTTP/1.1" + host + "X: " + std::string(100'000, 'x') + "\r\n\r\n");
  http_answer(place, "GET / HTTP/1.1" + host + "Content-Length: 100000\r\n\r\nx");
  http_answer(place, std::string(1000, '\0'));
  EXPECT_EQ(asked_status(place), 101);  // it is still there
}

TEST(WebServer, RestingPictureMatchesTheRenderer) {
  const Scene scene = scene_of(64, 48, 3);
  RunningServer server(scene);
  ViewClient client(server.place());
  const Json state = client.wait_for("state");
  EXPECT_EQ(state["scene"]["spheres"], scene.spheres.size());
  const auto first = client.wait_for_frame(0, 0, true);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->header.code, view::PictureCode::png);
  EXPECT_EQ(first->picture, png_of(render(scene)));
  for (const char* order : {"rows", "tiles", "progressive", "frameless"}) {
    client.send({{"type", "settings"}, {"number", 1}, {"panes", {{{"order", order}}}}});
    client.wait_for("state");
    client.send({{"type", "camera"},
                 {"number", 2},
                 {"moving", true},
                 {"camera", {{"eye", {0.1, 2.3, 5.7}}, {"fov", 41.5}}}});
    client.send({{"type", "camera"}, {"number", 3}, {"camera", {{"eye", {0.3, 2.5, 6.1}}}}});
    const auto rest = client.wait_for_frame(0, 3, true);
    ASSERT_TRUE(rest);
    Scene moved = scene;
    moved.camera = pinhole({0.3F, 2.5F, 6.1F}, {0, 0.8F, 0}, 41.5F);
    EXPECT_EQ(rest->picture, png_of(render(moved))) << order;
    client.send(
        {{"type", "camera"}, {"number", 4}, {"camera", {{"eye", {0.5, 1.6, 6}}, {"fov", 50}}}});
    EXPECT_EQ(client.wait_for_frame(0, 4, true)->picture, first->picture) << order;
  }
}

TEST(WebServer, LinesAndFogMatchTheRenderer) {
  Scene scene = scene_of(64, 48, 2);
  RunningServer server(scene);
  ViewClient client(server.place());
  ASSERT_TRUE(client.wait_for_frame(0, 0, true));
  scene.image.outline = 2;
  scene.image.fog = 0.75F;
  client.send({{"type", "settings"}, {"number", 1}, {"outline", 2}, {"fog", 0.75}});
  const auto both = client.wait_for_frame(0, 1, true);
  ASSERT_TRUE(both);
  EXPECT_EQ(both->picture, png_of(render(scene)));
  // The camera moves, and the depths of the fog with it.
  const Vec3f eye{0.25F, 2, 9};
  client.send({{"type", "camera"}, {"number", 2}, {"camera", {{"eye", {eye.x, eye.y, eye.z}}}}});
  scene.camera = pinhole(eye, {0, 0.8F, 0}, 50);
  EXPECT_EQ(client.wait_for_frame(0, 2, true)->picture, png_of(render(scene)));
  client.send({{"type", "settings"}, {"number", 3}, {"fog", 1.5}});
  EXPECT_EQ(client.wait_for("error")["key"], "fog");
}

TEST(WebServer, TwoPanesAndTheirDifference) {
  const Scene scene = scene_of(64, 48, 1);
  RunningServer server(scene);
  ViewClient client(server.place());
  client.send({{"type", "settings"},
               {"number", 5},
               {"panes", {Json::object(), {{"shadow_epsilon", "none"}}}},
               {"difference", "color"}});
  std::string pictures[3];
  Json difference;
  for (int left = 3; left > 0 || difference.is_null();) {
    const auto message = client.next();
    ASSERT_TRUE(message);
    if (message->json && (*message->json)["type"] == "statistics")
      difference = (*message->json)["difference"];
    if (!message->frame || !message->frame->header.finished) continue;
    if (message->frame->header.number < 5) continue;
    std::string& mine = pictures[message->frame->header.pane];
    left -= mine.empty() ? 1 : 0;
    mine = message->frame->picture;
  }
  RenderOptions options = options_of(scene);
  EXPECT_EQ(pictures[0], png_of(render(scene, options)));
  options.shadow_epsilon = 0.0F;
  EXPECT_EQ(pictures[1], png_of(render(scene, options)));
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_GT(difference["pixels"], 0);
}

TEST(WebServer, PickedRaysAddUpToThePicture) {
  const Scene scene = scene_of(40, 30, 1);
  RunningServer server(scene);
  ViewClient client(server.place());
  const Image picture = render(scene);
  for (int i = 0; i < 30; i += 3) {
    client.send({{"type", "pick"}, {"id", i}, {"x", i + 5}, {"y", i}});
    const Json picked = client.wait_for("picked");
    ASSERT_EQ(picked["id"], i);
    const auto color = [](const Json& json) {
      return Color{json[0].get<float>(), json[1].get<float>(), json[2].get<float>()};
    };
    EXPECT_TRUE(same_bits(color(picked["color"]), picture.at(i + 5, i)));
    Color total;
    for (int depth = 0; depth <= 5; ++depth) {
      Color sum;
      for (const Json& ray : picked["rays"]) {
        if (ray["depth"] != depth || ray["kind"] == "shadow") continue;
        sum = sum + color(ray["throughput"]) * color(ray["own"]);
      }
      total = total + sum;
    }
    EXPECT_TRUE(same_bits(total, picture.at(i + 5, i)));
  }
}

TEST(WebServer, SavesPictures) {
  const Scene scene = scene_of(40, 30, 2);
  RunningServer server(scene);
  const ServerPlace place = server.place();
  ViewClient client(place);
  client.send({{"type", "save"}, {"id", 1}, {"format", "png"}, {"spp", 5}});
  const Json saved = client.wait_for("saved");
  EXPECT_EQ(saved["id"], 1);
  EXPECT_EQ(saved["name"], "test.png");
  const std::string url = saved["url"];
  const std::string answer = get(place, url, place.authority());
  EXPECT_THAT(answer, HasSubstr("attachment; filename=\"test.png\""));
  Scene finer = scene;
  finer.image.spp = 5;
  EXPECT_EQ(answer.substr(answer.find("\r\n\r\n") + 4), png_of(render(finer)));
  const std::string bare = url.substr(0, url.find('?'));
  EXPECT_THAT(get(place, bare, place.authority()), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(get(place, "/picture/9?token=" + place.token, place.authority()),
              StartsWith("HTTP/1.1 404 "));
}

TEST(WebServer, AnswersBrokenMessagesAndGoesOn) {
  RunningServer server(scene_of(32, 24, 1));
  ViewClient client(server.place());
  for (const std::string& text :
       {std::string("{"), std::string("[1, 2]"), std::string(R"({"type": "fly"})"),
        std::string(R"({"type": "camera", "number": 1, "camera": {"fov": 500}})"),
        std::string(R"({"type": "settings", "number": 1, "difference": "ulp"})"),
        std::string(R"({"type": "pick", "id": 1, "x": 32, "y": 0})"),
        std::string(R"({"type": "texts", "id": 1, "pane": 1})"),
        std::string(R"({"type": "frame", "number": 1, "frame": 3})"),
        std::string(R"({"type": "particles", "number": 1, "color": "q"})"),
        std::string(16'000, '[')}) {
    client.send_text(text);
    EXPECT_FALSE(client.wait_for("error").is_null()) << text;
  }
  client.send({{"type", "texts"}, {"id", 5}});
  EXPECT_EQ(client.wait_for("texts")["id"], 5);
}

TEST(WebServer, ClosesOnWhatNoPageSends) {
  RunningServer server(scene_of(32, 24, 1));
  const ServerPlace place = server.place();
  const auto code_after = [&](const auto& send) {
    ViewClient client(place);
    send(client);
    while (client.next()) {
    }
    return client.close_code();
  };
  EXPECT_EQ(code_after([](ViewClient& c) { c.send_text(std::string(100'000, ' ')); }), 1009);
  EXPECT_EQ(code_after([](ViewClient& c) { c.send_binary("bytes"); }), 1003);
  EXPECT_EQ(code_after([](ViewClient& c) {
              for (int i = 0; i < 3000; ++i) c.send_text("{\"type\": \"ack\", \"frame\": 0}");
            }),
            1008);
  EXPECT_EQ(asked_status(place), 101);
}

/// The keys of a struct of the scene, those of structs within it among them.
template <HasFields Struct>
std::vector<std::string> keys_of(const Struct& value) {
  std::vector<std::string> keys;
  each_field(value, [&keys](const auto& field, const auto& member) {
    if constexpr (HasFields<std::decay_t<decltype(member)>>) {
      for (const std::string& key : keys_of(member)) keys.push_back(key);
    } else {
      keys.emplace_back(field.key);
    }
  });
  return keys;
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST(WebServer, OffersEveryCameraWithItsKeys) {
  RunningServer server(scene_of(32, 24, 1));
  ViewClient client(server.place());
  const Json state = client.wait_for("state");
  const Json& choices = state["choices"];
  Json shown = state["camera"];
  int number = 0;
  const auto check = [&]<class Kind>(const Kind& camera) {
    if (std::is_same_v<Kind, LensCamera>) return;  // its numbers come from its file
    const std::string type(fields<Kind>.type);
    EXPECT_THAT(choices["camera_types"], testing::Contains(type));
    const Json& keys = choices["cameras"][type]["keys"];
    EXPECT_THAT(keys_of(keys), testing::UnorderedElementsAreArray(keys_of(camera))) << type;
    client.send({{"type", "camera"}, {"number", ++number}, {"camera", {{"type", type}}}});
    while (shown["type"] != type) shown = client.wait_for("state").at("camera");
    for (const std::string& key : keys_of(camera)) EXPECT_TRUE(shown.contains(key)) << key;
  };
  const auto check_all = [&]<class... Kinds>(const std::variant<Kinds...>&) {
    (check(Kinds{}), ...);
  };
  check_all(Camera{});
  EXPECT_THAT(keys_of(choices["cameras"]["lens"]["keys"]),
              testing::UnorderedElementsAre("eye", "look_at", "up", "focus"));
}

TEST(WebServer, TellsTheRulesOfCameraKeys) {
  RunningServer server(scene_of(32, 24, 1));
  const Json cameras = ViewClient(server.place()).wait_for("state")["choices"]["cameras"];
  EXPECT_EQ(cameras["pinhole"]["projection"], "flat");
  EXPECT_EQ(cameras["orthographic"]["projection"], "parallel");
  EXPECT_EQ(cameras["fisheye"]["projection"], "angle");
  EXPECT_EQ(cameras["thin_lens"]["projection"], "flat");
  EXPECT_EQ(cameras["lens"]["projection"], "other");
  const Json& lens = cameras["thin_lens"]["keys"];
  EXPECT_EQ(lens["fov"], Json::parse(R"({"kind": "number", "low": 0.0, "high": 180.0,
                                         "unit": "degrees", "optional": false})"));
  EXPECT_EQ(lens["focus"], Json::parse(R"({"kind": "number", "low": 0.0, "high": null, "unit": "",
                                           "optional": true})"));
  EXPECT_EQ(lens["fov_axis"], Json::parse(R"({"kind": "name", "names": ["x", "y", "max"]})"));
  EXPECT_EQ(lens["eye"]["kind"], "point");
  EXPECT_EQ(lens["up"]["kind"], "direction");
}

TEST(WebServer, MemoryIsBoundedWhileACameraMoves) {
  RunningServer server(scene_of(160, 120, 1));
  ViewClient client(server.place());
  const int moves = [] {
    const char* const text = std::getenv("BOULE_VIEW_MOVES");
    return text != nullptr ? std::atoi(text) : 300;
  }();
  std::uint64_t after_warming = 0;
  for (int i = 1; i <= moves; ++i) {
    const double angle = 0.01 * i;
    client.send({{"type", "camera"},
                 {"number", i},
                 {"moving", true},
                 {"camera", {{"eye", {6 * std::sin(angle), 1.6, 6 * std::cos(angle)}}}}});
    ASSERT_TRUE(client.wait_for_frame(0, static_cast<std::uint32_t>(i), false));
    if (i == moves / 3) after_warming = resident_bytes();
  }
  EXPECT_LT(resident_bytes(), after_warming + (std::uint64_t{8} << 20));
}

TEST(WebServer, EndsWhenNobodyIsThere) {
  RunningServer server(scene_of(32, 24, 1), 0.2);
  {
    ViewClient client(server.place());
    ASSERT_TRUE(client.wait_for_frame(0, 0, true));
  }
  const auto begin = std::chrono::steady_clock::now();
  while (!server.ended()) {
    ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(server.stop());
}

TEST(WebServer, TellsItsClientThatItEnds) {
  RunningServer server(scene_of(32, 24, 1));
  ViewClient client(server.place());
  ASSERT_FALSE(client.wait_for("state").is_null());
  const Threads stopping(1, [&](std::size_t) { static_cast<void>(server.stop()); });
  while (client.next()) {
  }
  EXPECT_EQ(client.close_code(), 1000);
}

}  // namespace
}  // namespace boule::test
