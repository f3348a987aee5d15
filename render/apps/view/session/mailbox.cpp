#include "render/apps/view/session/mailbox.h"

#include <utility>

#include "core/base/float_environment.h"

namespace boule::view {
namespace {

/// A moving camera that sends nothing for so long is at rest.
constexpr std::chrono::milliseconds longest_pause{150};

PaneSettings with(PaneSettings pane, const PaneEdit& edit) {
  pane.order = edit.order.value_or(pane.order);
  pane.solver = edit.solver.value_or(pane.solver);
  pane.method = edit.method.value_or(pane.method);
  pane.shadow_epsilon = edit.shadow_epsilon.value_or(pane.shadow_epsilon);
  return pane;
}

}  // namespace

Status Mailbox::take(const ClientMessage& message) {
  const FloatEnvironment floats;
  const std::lock_guard lock(mutex_);
  auto done = std::visit([this](const auto& any) { return apply(any); }, message);
  if (!done) return done;
  if (news_.camera || news_.settings || news_.scene || news_.stop) overtaken_ = true;
  if (news_.any()) changed_.notify_all();
  return {};
}

void Mailbox::count(std::uint32_t number) {
  if (is_later(number, wish_.number)) wish_.number = number;
}

Status Mailbox::apply(const CameraMessage& message) {
  auto camera = edited(wish_.camera, message.edit, origin_);
  if (!camera) return camera.error();
  news_.camera_type |= camera.value().index() != wish_.camera.index();
  wish_.camera = std::move(camera).value();
  ++wish_.camera_revision;
  count(message.number);
  moving_until_ = message.moving ? Clock::now() + longest_pause : Clock::time_point{};
  news_.camera = true;
  news_.mover = message.moving ? message.client : 0;
  return {};
}

Status Mailbox::apply(const SettingsMessage& message) {
  ViewSettings settings = wish_.settings;
  if (message.panes) {
    settings.panes.clear();
    for (const PaneEdit& pane : *message.panes) settings.panes.push_back(with(limits_.pane, pane));
  }
  settings.difference = message.difference.value_or(settings.difference);
  if (message.size) {
    settings.width = (*message.size)[0];
    settings.height = (*message.size)[1];
  }
  settings.spp = message.spp.value_or(settings.spp);
  settings.max_depth = message.max_depth.value_or(settings.max_depth);
  settings.exposure = message.exposure.value_or(settings.exposure);
  settings.outline = message.outline.value_or(settings.outline);
  settings.fog = message.fog.value_or(settings.fog);
  settings.pace = message.pace.value_or(settings.pace);
  if (settings.panes.size() < 2) {
    if (message.difference && settings.difference != Difference::none)
      return Diagnostic::about("difference", "needs two panes");
    settings.difference = Difference::none;
  }
  count(message.number);
  news_.settings = true;
  wish_.settings = std::move(settings);
  return {};
}

Status Mailbox::apply(const ParticlesMessage& message) {
  if (!limits_.particles)
    return Diagnostic::of("the colours of a scene file are in the file, not here");
  ParticleLook& look = wish_.look;
  look.color = message.color.value_or(look.color);
  look.map = message.map.value_or(look.map);
  look.range = message.range.value_or(look.range);
  look.ghost = message.ghost.value_or(look.ghost);
  look.opacity = message.opacity.value_or(look.opacity);
  look.outline_by = message.outline_by.value_or(look.outline_by);
  count(message.number);
  news_.scene = true;
  return {};
}

Status Mailbox::apply(const FrameMessage& message) {
  if (!limits_.frames || !limits_.frames->holds(message.frame))
    return Diagnostic::about("frame", "there is no such frame");
  wish_.frame = message.frame;
  count(message.number);
  news_.scene = true;
  return {};
}

Status Mailbox::check_pane(int pane) const {
  if (static_cast<std::size_t>(pane) < wish_.settings.panes.size()) return {};
  return Diagnostic::about("pane", "there is one pane");
}

Status Mailbox::apply(const PickMessage& message) {
  if (auto done = check_pane(message.pane); !done) return done;
  if (message.x >= wish_.settings.width) return Diagnostic::about("x", "lies beyond the picture");
  if (message.y >= wish_.settings.height) return Diagnostic::about("y", "lies beyond the picture");
  news_.picks[message.client] = message;
  return {};
}

Status Mailbox::apply(const SaveMessage& message) {
  if (auto done = check_pane(message.pane); !done) return done;
  news_.saves[message.client] = message;
  return {};
}

Status Mailbox::apply(const StopSavingMessage& message) {
  news_.stops[message.client] = message;
  return {};
}

Status Mailbox::apply(const TextsMessage& message) {
  if (auto done = check_pane(message.pane); !done) return done;
  news_.texts[message.client] = message;
  return {};
}

/// The outbox is told of these.
Status Mailbox::apply(const AckMessage&) {
  woken_ = true;
  changed_.notify_all();
  return {};
}

void Mailbox::connect() {
  const std::lock_guard lock(mutex_);
  news_.connected = true;
  changed_.notify_all();
}

void Mailbox::stop() {
  const std::lock_guard lock(mutex_);
  news_.stop = true;
  overtaken_ = true;
  changed_.notify_all();
}

void Mailbox::wake() {
  const std::lock_guard lock(mutex_);
  woken_ = true;
  changed_.notify_all();
}

News Mailbox::wait_until(Clock::time_point time, Wish& wish) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, time, [this] { return news_.any() || woken_; });
  woken_ = false;
  overtaken_ = false;
  wish = wish_;
  return std::exchange(news_, {});
}

bool Mailbox::is_moving(Clock::time_point time) const {
  const std::lock_guard lock(mutex_);
  return time < moving_until_;
}

Mailbox::Clock::time_point Mailbox::moving_until() const {
  const std::lock_guard lock(mutex_);
  return moving_until_;
}

void Mailbox::correct(const Wish& wish) {
  const std::lock_guard lock(mutex_);
  wish_.look = wish.look;
  wish_.frame = wish.frame;
  wish_.camera = wish.camera;
}

void Mailbox::set_origin(const Vec3d& origin) {
  const std::lock_guard lock(mutex_);
  origin_ = origin;
}

}  // namespace boule::view
