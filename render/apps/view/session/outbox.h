#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "render/apps/view/messages/frame_message.h"

namespace boule::view {

/// What waits to be sent to a client. It never grows without end and never makes anybody wait: of
/// each picture the newest waits, of each kind of report too, and where too many answers wait the
/// client has stopped reading and is given up. Any thread may use it.
class Outbox {
 public:
  /// `notify` is called, on the thread that adds something, when there may be something to send; it
  /// must be quick and call nothing here.
  explicit Outbox(std::function<void()> notify) : notify_(std::move(notify)) {}

  /// An answer, each of which is sent.
  void add_text(std::string text);
  /// A report, which takes the place of one with the same name that still waits.
  void report(const std::string& name, std::string text);
  /// A picture with the header that it goes with; its frame number is set here.
  void add_frame(FrameHeader header, const std::string& picture);

  /// Whether a picture of this pane waits to be sent.
  [[nodiscard]] bool holds_frame(int pane) const;

  struct Message {
    std::string bytes;
    bool binary = false;
  };
  /// The next message: texts first, then a picture if none is on its way.
  std::optional<Message> take();
  /// The client has shown that frame.
  void acknowledge(std::uint32_t frame);

  /// Whether more waits than a client that reads ever lets wait.
  [[nodiscard]] bool overflowed() const;

 private:
  static constexpr std::size_t most_waiting = std::size_t{4} << 20;  // bytes

  std::optional<Message> take_frame();

  const std::function<void()> notify_;
  mutable std::mutex mutex_;
  bool overflowed_ = false;
  std::deque<std::string> texts_;
  std::size_t waiting_ = 0;  ///< bytes of texts_
  std::map<std::string, std::string> reports_;
  struct Slot {
    std::string bytes;
    std::uint32_t frame = 0;
  };
  std::array<std::optional<Slot>, picture_count> frames_;
  std::size_t last_sent_ = 0;                ///< whose turn it was
  std::uint32_t last_frame_ = 0;             ///< number
  std::optional<std::uint32_t> on_its_way_;  ///< a frame's number
};

}  // namespace boule::view
