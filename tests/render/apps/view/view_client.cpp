#include "tests/render/apps/view/view_client.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <utility>

#include "render/apps/view/messages/client_message.h"

namespace boule::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using boost::asio::ip::tcp;

constexpr std::chrono::seconds patience{60};

tcp::endpoint endpoint_of(const ServerPlace& place) {
  return {asio::ip::make_address(place.host), place.port};
}

}  // namespace

ServerPlace::ServerPlace(const std::string& url) {
  const std::size_t begin = url.find("//") + 2, slash = url.find('/', begin);
  const std::size_t colon = url.rfind(':', slash);
  host = url.substr(begin, colon - begin);
  port = static_cast<unsigned short>(std::stoi(url.substr(colon + 1, slash - colon - 1)));
  token = url.substr(url.find("token=") + 6);
}

struct ViewClient::Socket {
  asio::io_context io;
  websocket::stream<beast::tcp_stream> stream{io};
  beast::flat_buffer buffer;
  /// Runs one operation to its end, or to the end of patience.
  template <class Start>
  bool wait(const Start& start) {
    bool good = false, ended = false;
    start([&](const beast::error_code& error) {
      good = !error;
      ended = true;
    });
    io.restart();
    io.run_for(patience);
    return ended && good;
  }
};

ViewClient::ViewClient(const ServerPlace& place, const Introduction& introduction)
    : socket_(std::make_unique<Socket>()) {
  auto& stream = socket_->stream;
  beast::error_code error;
  beast::get_lowest_layer(stream).socket().connect(endpoint_of(place), error);
  if (error) return;
  beast::get_lowest_layer(stream).socket().set_option(tcp::no_delay(true));
  const std::string host = introduction.host.value_or(place.authority());
  const std::string origin = introduction.origin.value_or("http://" + place.authority());
  stream.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    if (!origin.empty()) request.set(beast::http::field::origin, origin);
  }));
  stream.handshake(host, "/socket?token=" + introduction.token.value_or(place.token), error);
  stream.auto_fragment(false);
  stream.read_message_max(std::size_t{64} << 20);
}

ViewClient::~ViewClient() = default;

void ViewClient::send_text(const std::string& text) {
  beast::error_code ignored;
  socket_->stream.text(true);
  socket_->stream.write(asio::buffer(text), ignored);
}

void ViewClient::send_binary(const std::string& bytes) {
  beast::error_code ignored;
  socket_->stream.binary(true);
  socket_->stream.write(asio::buffer(bytes), ignored);
}

std::optional<ViewClient::Message> ViewClient::next() {
  Socket& socket = *socket_;
  socket.buffer.clear();
  const bool read = socket.wait([&](const auto& done) {
    socket.stream.async_read(socket.buffer,
                             [done](const beast::error_code& error, std::size_t) { done(error); });
  });
  if (!read) return std::nullopt;
  const std::string bytes = beast::buffers_to_string(socket.buffer.data());
  Message message;
  if (socket.stream.got_text()) {
    message.json = Json::parse(bytes);
    return message;
  }
  message.frame.emplace();
  if (!view::decode(bytes, *message.frame)) return std::nullopt;
  send({{"type", "ack"}, {"frame", message.frame->header.frame}});
  return message;
}

ViewClient::Json ViewClient::wait_for(const std::string& type) {
  while (auto message = next()) {
    if (message->json && (*message->json)["type"] == type) return *message->json;
  }
  return nullptr;
}

std::optional<view::Frame> ViewClient::wait_for_frame(int pane, std::uint32_t number,
                                                      bool finished) {
  while (auto message = next()) {
    if (!message->frame) continue;
    const view::FrameHeader& header = message->frame->header;
    if (header.pane == pane && !view::is_later(number, header.number) &&
        (header.finished || !finished))
      return std::move(message->frame);
  }
  return std::nullopt;
}

int ViewClient::close_code() const { return socket_->stream.reason().code; }

void ViewClient::drop() { beast::get_lowest_layer(socket_->stream).close(); }

std::string http_answer(const ServerPlace& place, const std::string& request, std::size_t most) {
  asio::io_context io;
  tcp::socket socket(io);
  beast::error_code error;
  socket.connect(endpoint_of(place), error);
  if (error) return {};
  asio::write(socket, asio::buffer(request), error);
  std::string answer;
  char part[4096];
  while (!error && answer.size() < most) {
    const std::size_t size = socket.read_some(asio::buffer(part), error);
    answer.append(part, size);
  }
  return answer;
}

int asked_status(const ServerPlace& place, const Introduction& introduction) {
  const std::string host = introduction.host.value_or(place.authority());
  const std::string origin = introduction.origin.value_or("http://" + place.authority());
  std::string request =
      "GET /socket?token=" + introduction.token.value_or(place.token) +
      " HTTP/1.1\r\nHost: " + host +
      "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n";
  if (!origin.empty()) request += "Origin: " + origin + "\r\n";
  const std::string answer = http_answer(place, request + "\r\n", 12);
  return answer.size() < 12 ? 0 : std::stoi(answer.substr(9, 3));
}

}  // namespace boule::test
