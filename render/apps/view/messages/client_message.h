#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "render/apps/view/messages/camera_edit.h"
#include "render/apps/view/messages/view_settings.h"

/// What clients send (docs/view_protocol.md).
namespace boule::view {

/// `client` below is who sent the message; its reader leaves it at 0.

/// Whether number `a` of a message comes after `b`. They go round: 0 follows the largest, so that
/// there is always a next one, whatever a client has sent.
inline bool is_later(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::int32_t>(a - b) > 0;
}

/// The longest message, in bytes.
inline constexpr std::size_t longest_message = 16384;

struct CameraMessage {
  std::uint32_t number = 0;
  CameraEdit edit;
  bool moving = false;
  int client = 0;
};

/// Any keys of a pane's settings.
struct PaneEdit {
  std::optional<PixelOrder> order;
  std::optional<Solver> solver;
  std::optional<Method> method;
  std::optional<std::optional<float>> shadow_epsilon;
};

struct SettingsMessage {
  std::uint32_t number = 0;
  std::optional<std::vector<PaneEdit>> panes;  ///< one or two
  std::optional<Difference> difference;
  std::optional<std::array<int, 2>> size;
  std::optional<int> spp, max_depth;
  std::optional<float> exposure, outline, fog;
  std::optional<double> pace;
};

struct ParticlesMessage {
  std::uint32_t number = 0;
  std::optional<std::string> color, map, ghost, outline_by;
  std::optional<std::optional<std::array<double, 2>>> range;
  std::optional<std::optional<double>> opacity;
};

struct FrameMessage {
  std::uint32_t number = 0;
  int frame = 0;
};

struct PickMessage {
  std::uint32_t id = 0;
  int pane = 0, x = 0, y = 0;
  int client = 0;
};

struct SaveMessage {
  std::uint32_t id = 0;
  int pane = 0;
  std::optional<int> spp;
  int client = 0;
};

struct StopSavingMessage {
  std::uint32_t id = 0;  ///< of the SaveMessage
  int client = 0;
};

struct TextsMessage {
  std::uint32_t id = 0;
  int pane = 0;
  int client = 0;
};

struct AckMessage {
  std::uint32_t frame = 0;
};

using ClientMessage =
    std::variant<CameraMessage, SettingsMessage, ParticlesMessage, FrameMessage, PickMessage,
                 SaveMessage, StopSavingMessage, TextsMessage, AckMessage>;

/// A message that was refused: its type and id as far as they were understood.
struct RefusedMessage {
  std::string type;
  std::optional<std::uint32_t> id;
  Diagnostic error;
};

/// Reads a message. Takes any bytes.
std::variant<ClientMessage, RefusedMessage> read_message(std::string_view text);

}  // namespace boule::view
