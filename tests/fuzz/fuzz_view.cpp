// Messages and addresses from the clients of boule view: any bytes.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "render/apps/view/messages/client_message.h"
#include "render/apps/view/messages/frame_message.h"
#include "render/apps/view/server/access.h"
#include "tests/fuzz/input_budget.h"
#include "tests/fuzz/require.h"

namespace {

using namespace boule::view;
using boule::fuzz::require;

/// Checks that messages hold what they promise.
struct Promises {
  void operator()(const CameraMessage& message) const {
    const CameraEdit& edit = message.edit;
    for (const auto& [key, value] : edit.values) {
      const auto* const point = std::get_if<boule::Vec3d>(&value);
      require(point == nullptr || std::isfinite(point->x + point->y + point->z),
              "points are finite");
    }
    // Whatever is in it: a camera that is valid, or an error.
    const auto camera = edited(boule::PinholeCamera{}, edit, {});
    if (camera) {
      require(!find_problem(camera.value()), "an edited camera is valid");
      require(!camera_toml(camera.value(), {}).empty(), "a camera has a text");
    } else {
      require(camera.error().key.starts_with("camera."), "an error names the key");
    }
  }
  void operator()(const SettingsMessage& message) const {
    if (message.panes)
      require(!message.panes->empty() && message.panes->size() <= 2, "one or two panes");
    if (message.size)
      require((*message.size)[0] >= 1 && (*message.size)[0] <= max_view_side &&
                  (*message.size)[1] >= 1 && (*message.size)[1] <= max_view_side,
              "sizes have limits");
    require(message.spp.value_or(1) >= 1 && message.spp.value_or(1) <= max_view_spp, "spp");
    require(message.pace.value_or(0) == 0 || *message.pace >= min_pace, "pace");
  }
  void operator()(const ParticlesMessage& message) const {
    if (message.range && *message.range)
      require((**message.range)[0] < (**message.range)[1], "a range grows");
  }
  void operator()(const PickMessage& message) const {
    require(message.x >= 0 && message.y >= 0 && message.x < max_view_side, "pixels");
  }
  template <class Other>
  void operator()(const Other&) const {}
};

void check_access(std::string_view text) {
  const Target target = read_target(text);
  require(target.path.size() <= text.size() && target.path.find('?') == std::string_view::npos,
          "a path ends at the query");
  if (const auto number = picture_number(target.path)) require(*number >= 0, "a number");
  const bool own = is_own_host(text);
  require(!own || text.find_first_of("/@ ?#\\%") == std::string_view::npos, "a host is plain");
  require(is_own_origin("http://" + std::string(text), text), "an origin is its host");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const boule::fuzz::InputBudget budget;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto read = read_message(text);
  if (const auto* message = std::get_if<ClientMessage>(&read)) {
    std::visit(Promises{}, *message);
  } else {
    const auto& refused = std::get<RefusedMessage>(read);
    require(!refused.error.message.empty(), "a refusal says why");
    for (const char c : refused.type)
      require(static_cast<unsigned char>(c) >= 0x20, "no control bytes");
  }
  check_access(text);
  Frame frame;
  if (decode(text, frame)) require(frame.picture.size() + frame_header_size == size, "a frame");
  return 0;
}
