#include "render/apps/view/session/audience.h"

#include <algorithm>
#include <utility>

namespace boule::view {

int Audience::join() {
  const std::lock_guard lock(mutex_);
  outboxes_.emplace(++last_, std::make_shared<Outbox>(notify_));
  return last_;
}

void Audience::leave(int client) {
  const std::lock_guard lock(mutex_);
  outboxes_.erase(client);
}

std::size_t Audience::size() const {
  const std::lock_guard lock(mutex_);
  return outboxes_.size();
}

std::shared_ptr<Outbox> Audience::outbox(int client) const {
  const std::lock_guard lock(mutex_);
  const auto found = outboxes_.find(client);
  return found == outboxes_.end() ? nullptr : found->second;
}

std::map<int, std::shared_ptr<Outbox>> Audience::all() const {
  const std::lock_guard lock(mutex_);
  return outboxes_;
}

void Audience::add_text(const std::string& text) {
  for (const auto& [client, outbox] : all()) outbox->add_text(text);
}

void Audience::report(const std::string& name, const std::string& text) {
  for (const auto& [client, outbox] : all()) outbox->report(name, text);
}

void Audience::add_frame(const FrameHeader& header, const std::string& picture) {
  for (const auto& [client, outbox] : all()) outbox->add_frame(header, picture);
}

void Audience::report_to_others(int client, const std::string& name, const std::string& text) {
  for (const auto& [other, outbox] : all()) {
    if (other != client) outbox->report(name, text);
  }
}

void Audience::answer(int client, std::string text) {
  if (const auto its = outbox(client)) its->add_text(std::move(text));
}

void Audience::report_to(int client, const std::string& name, std::string text) {
  if (const auto its = outbox(client)) its->report(name, std::move(text));
}

bool Audience::holds_frame(int pane) const {
  const auto outboxes = all();
  return std::all_of(outboxes.begin(), outboxes.end(),
                     [pane](const auto& one) { return one.second->holds_frame(pane); });
}

}  // namespace boule::view
