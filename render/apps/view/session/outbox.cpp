#include "render/apps/view/session/outbox.h"

#include <utility>

namespace boule::view {

void Outbox::add_text(std::string text) {
  {
    const std::lock_guard lock(mutex_);
    if (overflowed_) return;
    waiting_ += text.size();
    overflowed_ = waiting_ > most_waiting;
    texts_.push_back(std::move(text));
  }
  notify_();
}

void Outbox::report(const std::string& name, std::string text) {
  {
    const std::lock_guard lock(mutex_);
    reports_[name] = std::move(text);
  }
  notify_();
}

void Outbox::add_frame(FrameHeader header, const std::string& picture) {
  {
    const std::lock_guard lock(mutex_);
    header.frame = ++last_frame_;
    const auto head = encode(header);
    Slot slot{std::string(head.data(), head.size()) + picture, header.frame};
    frames_[static_cast<std::size_t>(header.pane)] = std::move(slot);
  }
  notify_();
}

bool Outbox::holds_frame(int pane) const {
  const std::lock_guard lock(mutex_);
  return frames_[static_cast<std::size_t>(pane)].has_value();
}

std::optional<Outbox::Message> Outbox::take() {
  const std::lock_guard lock(mutex_);
  if (!texts_.empty()) {
    Message message{std::move(texts_.front()), false};
    texts_.pop_front();
    waiting_ -= message.bytes.size();
    return message;
  }
  if (!reports_.empty()) {
    Message message{std::move(reports_.begin()->second), false};
    reports_.erase(reports_.begin());
    return message;
  }
  return take_frame();
}

std::optional<Outbox::Message> Outbox::take_frame() {
  if (on_its_way_) return std::nullopt;
  for (std::size_t step = 1; step <= frames_.size(); ++step) {
    const std::size_t i = (last_sent_ + step) % frames_.size();
    if (!frames_[i]) continue;
    Message message{std::move(frames_[i]->bytes), true};
    on_its_way_ = frames_[i]->frame;
    frames_[i].reset();
    last_sent_ = i;
    return message;
  }
  return std::nullopt;
}

void Outbox::acknowledge(std::uint32_t frame) {
  {
    const std::lock_guard lock(mutex_);
    if (on_its_way_ != frame) return;
    on_its_way_.reset();
  }
  notify_();
}

bool Outbox::overflowed() const {
  const std::lock_guard lock(mutex_);
  return overflowed_;
}

}  // namespace boule::view
