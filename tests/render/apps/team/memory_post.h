#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/apps/team/post.h"

namespace boule::test {

/// Letters between ranks that are threads of one process.
struct MemoryMail {
  explicit MemoryMail(int size) : boxes(static_cast<std::size_t>(size)) {}
  std::mutex mutex;
  std::vector<std::deque<Letter>> boxes;
  bool ended = false;  ///< end_all() was called
};

class MemoryPost : public Post {
 public:
  MemoryPost(std::shared_ptr<MemoryMail> mail, int rank) : mail_(std::move(mail)), rank_(rank) {}

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return static_cast<int>(mail_->boxes.size()); }
  void send(int to, std::string_view bytes) override {
    const std::lock_guard lock(mail_->mutex);
    mail_->boxes[static_cast<std::size_t>(to)].push_back({rank_, std::string(bytes)});
  }
  std::optional<Letter> receive() override {
    const std::lock_guard lock(mail_->mutex);
    auto& box = mail_->boxes[static_cast<std::size_t>(rank_)];
    if (box.empty()) return std::nullopt;
    Letter letter = std::move(box.front());
    box.pop_front();
    return letter;
  }
  bool idle() override { return true; }
  void finish() override {}
  void end_all(int /*code*/) override {
    const std::lock_guard lock(mail_->mutex);
    mail_->ended = true;
  }

 private:
  std::shared_ptr<MemoryMail> mail_;
  int rank_;
};

}  // namespace boule::test
