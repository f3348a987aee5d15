#include "render/apps/view/messages/client_message.h"

#include <cmath>
#include <utility>

#include "render/apps/view/messages/camera_kinds.h"
#include "render/apps/view/messages/message_keys.h"

namespace boule::view {
namespace {

Result<ClientMessage> finished(MessageKeys& keys, ClientMessage message) {
  if (auto done = keys.finish(); !done) return done.error();
  return message;
}

// Values of the keys of cameras, by the members that take them.

std::optional<CameraValue> value_of(MessageKeys& keys, const char* key, const Vec3f&) {
  return keys.vector(key);
}
std::optional<CameraValue> value_of(MessageKeys& keys, const char* key, float) {
  return keys.number(key);
}
std::optional<CameraValue> value_of(MessageKeys& keys, const char* key,
                                    const std::optional<float>&) {
  const Json* const value = keys.find(key);
  if (value != nullptr && value->is_null()) return CameraValue();
  return keys.number(key);
}
template <class Enum>
std::optional<CameraValue> value_of(MessageKeys& keys, const char* key, Enum) {
  const auto choice = keys.choice<Enum>(key);
  if (!choice) return std::nullopt;
  return std::string(name_of(*choice));
}

Result<ClientMessage> read_camera(MessageKeys& keys) {
  CameraMessage message;
  message.number = keys.counter("number");
  message.moving = keys.flag("moving").value_or(false);
  const Json* const camera = keys.find("camera");
  if (camera == nullptr) return finished(keys, message);
  MessageKeys inner(*camera, "camera.");
  CameraEdit& edit = message.edit;
  edit.type = inner.text("type");
  each_kind([&](const auto& kind) {
    each_key(kind, [&](const auto& field, const auto& member) {
      const std::string key(field.key);
      if (const auto value = value_of(inner, key.c_str(), member)) edit.values[key] = *value;
    });
  });
  if (auto done = inner.finish(); !done) return done.error();
  return finished(keys, message);
}

/// "none", null or a length.
void read_epsilon(MessageKeys& keys, PaneEdit& pane) {
  const Json* const value = keys.find("shadow_epsilon");
  if (value == nullptr) return;
  if (value->is_null()) {
    pane.shadow_epsilon.emplace();
  } else if (value->is_string() && *value == "none") {
    pane.shadow_epsilon.emplace(0.0F);
  } else if (const auto number = keys.number("shadow_epsilon", 0, 1e30)) {
    pane.shadow_epsilon.emplace(static_cast<float>(*number));
  }
}

Result<PaneEdit> read_pane(const Json& json, std::size_t index) {
  MessageKeys keys(json, "panes[" + std::to_string(index) + "].");
  PaneEdit pane;
  pane.order = keys.choice<PixelOrder>("order");
  pane.solver = keys.choice<Solver>("solver");
  pane.method = keys.choice<Method>("method");
  read_epsilon(keys, pane);
  if (auto done = keys.finish(); !done) return done.error();
  return pane;
}

Status read_panes(MessageKeys& keys, SettingsMessage& message) {
  const Json* const panes = keys.find("panes");
  if (panes == nullptr) return {};
  if (!panes->is_array() || panes->empty() || panes->size() > 2)
    return Diagnostic::about("panes", "expected an array of one or two objects");
  message.panes.emplace();
  for (std::size_t i = 0; i < panes->size(); ++i) {
    auto pane = read_pane((*panes)[i], i);
    if (!pane) return pane.error();
    message.panes->push_back(pane.value());
  }
  return {};
}

std::optional<int> small_whole(MessageKeys& keys, const char* key, int low, int high) {
  const auto found = keys.whole(key, low, high);
  return found ? std::optional(static_cast<int>(*found)) : std::nullopt;
}

std::optional<float> small_number(MessageKeys& keys, const char* key, double low, double high) {
  const auto found = keys.number(key, low, high);
  return found ? std::optional(static_cast<float>(*found)) : std::nullopt;
}

Result<ClientMessage> read_settings(MessageKeys& keys) {
  SettingsMessage message;
  message.number = keys.counter("number");
  if (auto done = read_panes(keys, message); !done) return done.error();
  message.difference = keys.choice<Difference>("difference");
  if (const Json* const size = keys.find("size")) {
    if (const auto sides = keys.numbers<2>("size", *size, 1, max_view_side)) {
      message.size = {static_cast<int>((*sides)[0]), static_cast<int>((*sides)[1])};
      for (const double side : *sides) {
        if (side != std::floor(side)) keys.report("size", "expected whole numbers");
      }
    }
  }
  message.spp = small_whole(keys, "spp", 1, max_view_spp);
  message.max_depth = small_whole(keys, "max_depth", 0, max_view_depth);
  message.exposure = small_number(keys, "exposure", -100, 100);
  message.outline = small_number(keys, "outline", 0, 100);
  message.fog = small_number(keys, "fog", 0, 1);
  message.pace = keys.number("pace", 0, max_pace);
  if (message.pace && *message.pace > 0 && *message.pace < min_pace)
    keys.report("pace", "expected 0 or at least 1000 pixels a second");
  return finished(keys, message);
}

Result<ClientMessage> read_particles(MessageKeys& keys) {
  ParticlesMessage message;
  message.number = keys.counter("number");
  message.color = keys.text("color");
  message.map = keys.text("map");
  message.ghost = keys.text("ghost");
  message.outline_by = keys.text("outline_by");
  if (const Json* const opacity = keys.find("opacity")) {
    if (opacity->is_null()) {
      message.opacity.emplace();
    } else if (const auto share = keys.number("opacity", 0, 1)) {
      message.opacity.emplace(share);
    }
  }
  if (const Json* const range = keys.find("range")) {
    if (range->is_null()) {
      message.range.emplace();
    } else if (const auto ends = keys.numbers<2>("range", *range, -1e300, 1e300)) {
      if (!((*ends)[0] < (*ends)[1])) keys.report("range", "expected two numbers that grow");
      message.range.emplace(ends);
    }
  }
  return finished(keys, message);
}

Result<ClientMessage> read_frame(MessageKeys& keys) {
  FrameMessage message;
  message.number = keys.counter("number");
  const auto frame = small_whole(keys, "frame", 0, 2147483647);
  if (!frame) keys.report("frame", "expected a whole number");
  message.frame = frame.value_or(0);
  return finished(keys, message);
}

int pane_of(MessageKeys& keys) { return small_whole(keys, "pane", 0, 1).value_or(0); }

int pixel_of(MessageKeys& keys, const char* key) {
  const auto pixel = small_whole(keys, key, 0, max_view_side - 1);
  if (!pixel) keys.report(key, "expected the number of a pixel");
  return pixel.value_or(0);
}

Result<ClientMessage> read_pick(MessageKeys& keys) {
  PickMessage message;
  message.id = keys.counter("id");
  message.pane = pane_of(keys);
  message.x = pixel_of(keys, "x");
  message.y = pixel_of(keys, "y");
  return finished(keys, message);
}

Result<ClientMessage> read_save(MessageKeys& keys) {
  SaveMessage message;
  message.id = keys.counter("id");
  message.pane = pane_of(keys);
  message.spp = small_whole(keys, "spp", 1, max_view_spp);
  const auto format = keys.text("format");
  if (format && *format != "png") keys.report("format", "expected png");
  return finished(keys, message);
}

Result<ClientMessage> read_texts(MessageKeys& keys) {
  TextsMessage message;
  message.id = keys.counter("id");
  message.pane = pane_of(keys);
  return finished(keys, message);
}

Result<ClientMessage> read_stop_saving(MessageKeys& keys) {
  StopSavingMessage message;
  message.id = keys.counter("id");
  return finished(keys, message);
}

Result<ClientMessage> read_ack(MessageKeys& keys) {
  AckMessage message;
  message.frame = keys.counter("frame");
  return finished(keys, message);
}

Result<ClientMessage> read_type(const std::string& type, MessageKeys& keys) {
  if (type == "camera") return read_camera(keys);
  if (type == "settings") return read_settings(keys);
  if (type == "particles") return read_particles(keys);
  if (type == "frame") return read_frame(keys);
  if (type == "pick") return read_pick(keys);
  if (type == "save") return read_save(keys);
  if (type == "stop_saving") return read_stop_saving(keys);
  if (type == "texts") return read_texts(keys);
  if (type == "ack") return read_ack(keys);
  return Diagnostic::about("type", "unknown type of message");
}

/// The id of a message, as far as it has one.
std::optional<std::uint32_t> id_of(const Json& json) {
  if (!json.is_object() || !json.contains("id")) return std::nullopt;
  MessageKeys keys(json);
  const auto id = keys.whole("id", 0, 4294967295);
  return id ? std::optional(static_cast<std::uint32_t>(*id)) : std::nullopt;
}

}  // namespace

std::variant<ClientMessage, RefusedMessage> read_message(std::string_view text) {
  if (text.size() > longest_message)
    return RefusedMessage{{}, {}, Diagnostic::of("the message is too long")};
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return RefusedMessage{{}, {}, Diagnostic::of("the message is no JSON")};
  MessageKeys keys(json);
  const std::string type = keys.text("type").value_or("");
  auto message = read_type(type, keys);
  if (message) return std::move(message).value();
  return RefusedMessage{printable(type, 40), id_of(json), message.error()};
}

}  // namespace boule::view
