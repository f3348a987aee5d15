#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "render/apps/view/session/outbox.h"

namespace boule::view {

/// The clients of a session, each with an outbox: all see the same. Any thread may use it.
class Audience {
 public:
  /// `notify` as that of an Outbox.
  explicit Audience(std::function<void()> notify) : notify_(std::move(notify)) {}

  /// A client has come: its number, from 1.
  int join();
  void leave(int client);
  [[nodiscard]] std::size_t size() const;
  /// That of a client that is there; null if it has gone.
  [[nodiscard]] std::shared_ptr<Outbox> outbox(int client) const;

  /// To all, as those of an Outbox.
  void add_text(const std::string& text);
  void report(const std::string& name, const std::string& text);
  void add_frame(const FrameHeader& header, const std::string& picture);
  /// The same for all but one.
  void report_to_others(int client, const std::string& name, const std::string& text);

  /// To one client, if it is there.
  void answer(int client, std::string text);
  void report_to(int client, const std::string& name, std::string text);

  /// Whether a picture of this pane waits in every outbox.
  [[nodiscard]] bool holds_frame(int pane) const;

 private:
  [[nodiscard]] std::map<int, std::shared_ptr<Outbox>> all() const;

  const std::function<void()> notify_;
  mutable std::mutex mutex_;
  std::map<int, std::shared_ptr<Outbox>> outboxes_;
  int last_ = 0;
};

}  // namespace boule::view
