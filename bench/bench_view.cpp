// How fast boule view answers a moving camera: the time from a camera's message to the first frame
// that shows it, and frames a second; then how long the picture takes to have all its pixels again
// at rest. The client is the tests', over the loopback of this machine.
//
//   bench_view SCENE [WIDTH HEIGHT [SECONDS [ORDER]]]        960 540 5 progressive
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/math/geometry.h"
#include "render/files/scene_file/scene_file.h"
#include "tests/render/apps/view/view_server.h"

namespace boule::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Json = test::ViewClient::Json;

double milliseconds(Clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

struct Arguments {
  std::string scene;
  int width = 960, height = 540;
  double seconds = 5;
  std::string order = "progressive";
};

/// A camera on a circle around what the first one looks at.
Json turned(const Json& first, double angle) {
  const auto at = [](const Json& point, std::size_t i) { return point[i].get<double>(); };
  const Json &eye = first["eye"], &center = first["look_at"];
  const double x = at(eye, 0) - at(center, 0), z = at(eye, 2) - at(center, 2);
  return {{"eye",
           {at(center, 0) + x * std::cos(angle) + z * std::sin(angle), at(eye, 1),
            at(center, 2) - x * std::sin(angle) + z * std::cos(angle)}}};
}

/// What a run has shown.
struct Figures {
  std::vector<double> latencies;  ///< milliseconds
  int frames = 0;
  int coarsest = 1;  ///< scale
  double seconds = 0;
  double full_after = 0;  ///< milliseconds from the last message to a frame of scale 1 at rest
};

/// Moves the camera, each time when the last one was seen, and then lets it rest.
Figures run(test::ViewClient& client, const Json& camera, double seconds) {
  Figures figures;
  std::uint32_t number = 1;
  const auto begin = Clock::now();
  auto sent = begin;
  const auto move = [&](bool moving) {
    sent = Clock::now();
    client.send({{"type", "camera"},
                 {"number", ++number},
                 {"moving", moving},
                 {"camera", turned(camera, 0.01 * number)}});
  };
  move(true);
  while (Clock::now() - begin < std::chrono::duration<double>(seconds)) {
    const auto message = client.next();
    if (!message) return figures;
    if (!message->frame) continue;
    ++figures.frames;
    const view::FrameHeader& header = message->frame->header;
    figures.coarsest = std::max(figures.coarsest, header.scale);
    if (header.number < number) continue;
    figures.latencies.push_back(milliseconds(Clock::now() - sent));
    move(true);
  }
  figures.seconds = milliseconds(Clock::now() - begin) / 1000;
  move(false);
  while (const auto message = client.next()) {
    if (!message->frame || message->frame->header.number < number) continue;
    if (message->frame->header.scale != 1 || message->frame->header.spp < 1) continue;
    figures.full_after = milliseconds(Clock::now() - sent);
    break;
  }
  return figures;
}

double at_share(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

int measure(const Arguments& arguments) {
  auto loaded = load_scene(arguments.scene);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", format_diagnostic(loaded.error()).c_str());
    return 3;
  }
  Scene scene = std::move(loaded).value().scene;
  scene.image.width = arguments.width;
  scene.image.height = arguments.height;
  test::RunningServer server(scene);
  test::ViewClient client(server.place());
  const Json camera = client.wait_for("state")["camera"];
  client.send({{"type", "settings"}, {"number", 1}, {"panes", {{{"order", arguments.order}}}}});
  if (!client.wait_for_frame(0, 1, true)) return 1;
  const Figures figures = run(client, camera, arguments.seconds);
  std::printf(
      "%s, %d x %d, %s: latency median %.1f ms, 95 %% %.1f ms, longest %.1f ms; %.1f frames/s, "
      "coarsest scale %d; all pixels %.1f ms after the camera rests\n",
      arguments.scene.c_str(), arguments.width, arguments.height, arguments.order.c_str(),
      at_share(figures.latencies, 0.5), at_share(figures.latencies, 0.95),
      at_share(figures.latencies, 1), figures.frames / figures.seconds, figures.coarsest,
      figures.full_after);
  return 0;
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  boule::bench::Arguments arguments;
  if (argc < 2 || argc == 3) {
    std::fprintf(stderr, "usage: bench_view SCENE [WIDTH HEIGHT [SECONDS [ORDER]]]\n");
    return 2;
  }
  arguments.scene = argv[1];
  if (argc > 3) {
    arguments.width = std::max(std::atoi(argv[2]), 1);
    arguments.height = std::max(std::atoi(argv[3]), 1);
  }
  if (argc > 4) arguments.seconds = std::max(std::atof(argv[4]), 0.1);
  if (argc > 5) arguments.order = argv[5];
  return boule::bench::measure(arguments);
}
