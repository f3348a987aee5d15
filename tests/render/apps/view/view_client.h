#pragma once

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "render/apps/view/messages/frame_message.h"

namespace boule::test {

/// Where a server of boule view is, taken from its URL.
struct ServerPlace {
  std::string host;  ///< a number
  unsigned short port = 0;
  std::string token;

  explicit ServerPlace(const std::string& url);
  [[nodiscard]] std::string authority() const { return host + ":" + std::to_string(port); }
};

/// What a connection says of itself; what is empty is as a browser on the server's own page has it.
struct Introduction {
  std::optional<std::string> token{}, host{}, origin{};
};

/// A client of boule view's WebSocket, which waits for what it asks for. What takes longer than a
/// minute fails.
class ViewClient {
 public:
  using Json = nlohmann::json;

  explicit ViewClient(const ServerPlace& place, const Introduction& introduction = {});
  ~ViewClient();
  ViewClient(const ViewClient&) = delete;
  ViewClient& operator=(const ViewClient&) = delete;

  void send(const Json& message) { send_text(message.dump()); }
  void send_text(const std::string& text);
  void send_binary(const std::string& bytes);

  /// One message: a text, or a frame, which is acknowledged at once.
  struct Message {
    std::optional<Json> json;
    std::optional<view::Frame> frame;
  };
  /// The next message; none once the connection has ended.
  std::optional<Message> next();
  /// The next text of this type; null if the connection ends before.
  Json wait_for(const std::string& type);
  /// The next frame of a pane that shows this number of a message or a later one, and is finished
  /// if that is asked for. None if the connection ends before.
  std::optional<view::Frame> wait_for_frame(int pane, std::uint32_t number, bool finished);

  /// The code with which the server closed, once next() has returned nothing.
  [[nodiscard]] int close_code() const;
  /// Ends the connection without a word.
  void drop();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

/// The HTTP status of the answer to a client that asks for a session; 0 without an answer.
int asked_status(const ServerPlace& place, const Introduction& introduction = {});

/// The answer to one HTTP request, as it is, or its beginning; empty without one.
std::string http_answer(const ServerPlace& place, const std::string& request,
                        std::size_t most = std::string::npos);

}  // namespace boule::test
