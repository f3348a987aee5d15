#include "render/apps/view/server/web_server.h"

#include <atomic>
#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "render/apps/view/messages/client_message.h"
#include "render/apps/view/server/access.h"
#include "render/apps/view/server/listener.h"
#include "render/apps/view/server/page_files.h"
#include "render/apps/view/session/audience.h"
#include "render/apps/view/session/picture_store.h"
#include "render/apps/view/session/view_session.h"

namespace boule::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using Protocol = asio::generic::stream_protocol;  // of TCP, or of a socket in the file system
using Stream = beast::basic_stream<Protocol>;
using Error = beast::error_code;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t longest_header = 8192, most_connections = 64;
constexpr seconds longest_request{10}, longest_download{600};
constexpr int most_messages = 2000;  // in a second

class SocketClient;

/// What all connections share, on one thread.
struct Hub {
  asio::io_context io{1};
  const ServerSettings* settings = nullptr;
  ViewSession* session = nullptr;
  std::vector<std::weak_ptr<SocketClient>> clients;  ///< those of the session
  std::size_t connections = 0;
  std::chrono::steady_clock::time_point last_seen = std::chrono::steady_clock::now();
};

/// Counts a connection while it lives.
class Counted {
 public:
  explicit Counted(Hub& hub) : hub_(hub) { ++hub_.connections; }
  ~Counted() { --hub_.connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Hub& hub_;
};

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

/// A client of the session: its messages go in, and what its outbox holds goes out, one message at
/// a time.
class SocketClient : public std::enable_shared_from_this<SocketClient> {
 public:
  SocketClient(Hub& hub, Stream stream)
      : hub_(hub), counted_(hub), socket_(std::move(stream)), deadline_(hub.io) {}

  ~SocketClient() {
    if (!outbox_) return;
    hub_.last_seen = std::chrono::steady_clock::now();
    hub_.session->disconnect(number_);
  }

  void accept(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.idle_timeout = seconds(60);
    timeouts.keep_alive_pings = true;
    socket_.set_option(timeouts);
    socket_.read_message_max(0);  // read() has a limit of its own
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](const Error& error) {
      if (!error) self->begin();
    });
  }

  /// Sends what waits, if nothing is being sent.
  void pump() {
    if (!outbox_ || sending_) return;
    if (outbox_->overflowed()) return close(websocket::close_code::policy_error);
    auto message = outbox_->take();
    if (!message) return;
    sending_ = true;
    outgoing_ = std::move(message->bytes);
    socket_.binary(message->binary);
    socket_.async_write(asio::buffer(outgoing_),
                        [self = shared_from_this()](const Error& error, std::size_t) {
                          self->sending_ = false;
                          if (!error) self->pump();
                        });
  }

  void forget_session() { outbox_.reset(); }

  void close(websocket::close_code code) {
    if (closing_ || !outbox_) return;
    closing_ = true;
    // A client that reads nothing would let the closing wait: it is cut off.
    deadline_.expires_after(seconds(2));
    deadline_.async_wait([weak = weak_from_this()](const Error& error) {
      const auto self = weak.lock();
      if (!error && self) beast::get_lowest_layer(self->socket_).close();
    });
    socket_.async_close(code, [self = shared_from_this()](const Error&) {});
  }

 private:
  void begin() {
    number_ = hub_.session->connect();
    outbox_ = hub_.session->audience().outbox(number_);
    hub_.clients.push_back(weak_from_this());
    read();
    pump();
  }

  /// Reads a part of a message. A message that is too long is closed by close(), which reads what
  /// the client still sends: Beast's own limit closes the connection with that unread, which resets
  /// it, and the client may never learn why.
  void read() {
    socket_.async_read_some(buffer_, longest_message + 1 - buffer_.size(),
                            [self = shared_from_this()](const Error& error, std::size_t) {
                              if (!error) self->handle();
                            });
  }

  void handle() {
    if (!outbox_ || closing_) return;
    if (!socket_.got_text()) return close(websocket::close_code::unknown_data);
    if (buffer_.size() > longest_message) return close(websocket::close_code::too_big);
    if (!socket_.is_message_done()) return read();
    if (!has_time_for_more()) return close(websocket::close_code::policy_error);
    const auto data = buffer_.data();
    hub_.session->receive(number_, {static_cast<const char*>(data.data()), data.size()});
    buffer_.consume(buffer_.size());
    read();
  }

  bool has_time_for_more() {
    const auto now = std::chrono::steady_clock::now();
    if (now - second_began_ >= seconds(1)) {
      second_began_ = now;
      messages_ = 0;
    }
    return ++messages_ <= most_messages;
  }

  Hub& hub_;
  const Counted counted_;
  websocket::stream<Stream, false> socket_;  // false: nothing is compressed
  asio::steady_timer deadline_;
  beast::flat_buffer buffer_;
  std::string outgoing_;
  int number_ = 0;                  ///< in the session
  std::shared_ptr<Outbox> outbox_;  ///< null before and after it has the session
  bool sending_ = false, closing_ = false;
  std::chrono::steady_clock::time_point second_began_{};
  int messages_ = 0;
};

/// One request, and its answer; or a socket, if it asks for one.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Hub& hub, Protocol::socket socket)
      : hub_(hub), counted_(hub), stream_(std::move(socket)), buffer_(2 * longest_header) {}

  void read() {
    parser_.header_limit(longest_header);
    parser_.body_limit(0);
    stream_.expires_after(longest_request);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](const Error& error, std::size_t) {
                       if (!error) return self->answer();
                       if (error == http::error::header_limit || error == http::error::body_limit)
                         self->refuse(http::status::payload_too_large, "too long");
                     });
  }

 private:
  void answer() {
    const Request& request = parser_.get();
    const std::string_view host = view_of(request[http::field::host]);
    const Target target = read_target(view_of(request.target()));
    if (!is_own_host(host))
      return refuse(http::status::misdirected_request,
                    "open the page by this machine's number, or as localhost");
    const bool allowed = same_secret(target.token, hub_.settings->token);
    if (websocket::is_upgrade(request) && target.path == "/socket") {
      const auto origin = request.find(http::field::origin);
      const bool is_foreign =
          origin != request.end() && !is_own_origin(view_of(origin->value()), host);
      if (!allowed || is_foreign) return refuse(http::status::forbidden, "forbidden");
      std::make_shared<SocketClient>(hub_, std::move(stream_))->accept(request);
      return;
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return refuse(http::status::method_not_allowed, "GET and HEAD only");
    send_file(target, allowed);
  }

  void send_file(const Target& target, bool allowed) {
    if (target.path == "/" && !allowed)
      return refuse(http::status::forbidden,
                    "the address must have the token that boule view has printed");
    if (const auto number = picture_number(target.path)) return send_picture(*number, allowed);
    const std::string_view name = target.path == "/" ? "index.html" : target.path.substr(1);
    for (const PageFile& file : page_files()) {
      if (file.name != name) continue;
      Response response(http::status::ok, 11);
      response.set(http::field::content_type,
                   beast::string_view(file.type.data(), file.type.size()));
      response.body() = std::string(file.bytes);
      return send(std::move(response));
    }
    refuse(http::status::not_found, "there is nothing of this name");
  }

  void send_picture(int number, bool allowed) {
    if (!allowed) return refuse(http::status::forbidden, "forbidden");
    const auto picture = hub_.session->pictures().find(number);
    if (!picture) return refuse(http::status::not_found, "this picture is gone");
    Response response(http::status::ok, 11);
    response.set(http::field::content_type, "image/png");
    std::string name;
    for (const char c : picture->name) name += c == '"' || c == '\\' || c < ' ' ? '_' : c;
    response.set(http::field::content_disposition, "attachment; filename=\"" + name + "\"");
    response.body() = picture->bytes;
    stream_.expires_after(longest_download);
    send(std::move(response));
  }

  void refuse(http::status status, const std::string& text) {
    Response response(status, 11);
    response.set(http::field::content_type, "text/plain; charset=utf-8");
    response.body() = text + "\n";
    send(std::move(response));
  }

  void send(Response response) {
    std::string policy =
        "default-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'";
    if (!hub_.settings->embed) policy += "; frame-ancestors 'none'";
    response.set("Content-Security-Policy", policy);
    response.set("Referrer-Policy", "no-referrer");
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.keep_alive(false);
    response.prepare_payload();
    if (parser_.get().method() == http::verb::head) response.body().clear();
    response_ = std::move(response);
    http::async_write(stream_, response_, [self = shared_from_this()](const Error&, std::size_t) {
      Error ignored;
      self->stream_.socket().shutdown(asio::socket_base::shutdown_send, ignored);
    });
  }

  Hub& hub_;
  const Counted counted_;
  Stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  Response response_;
};

}  // namespace

class WebServer::Implementation {
 public:
  Status serve(const ServerSettings& settings, ViewSession& session) {
    hub_.settings = &settings;
    hub_.session = &session;
    auto listener = Listener::open(settings);
    if (!listener) return listener.error();
    acceptor_.assign({listener.value().family(), 0}, listener.value().release());
    settings.ready(listener.value().url() + "/?token=" + settings.token);
    hub_.last_seen = std::chrono::steady_clock::now();
    accept();
    watch();
    hub_.io.run();
    close_all();
    return {};
  }

  void notify() {
    // One post is enough for all that is added before it runs.
    if (posted_.exchange(true)) return;
    asio::post(hub_.io, [this] {
      posted_ = false;
      for_clients([](SocketClient& client) { client.pump(); });
    });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](const Error& error, Protocol::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error && hub_.connections < most_connections) {
        Error ignored;
        socket.set_option(asio::ip::tcp::no_delay(true), ignored);
        std::make_shared<HttpConnection>(hub_, std::move(socket))->read();
      }
      accept();
    });
  }

  /// Looks now and then whether it is time to end.
  void watch() {
    timer_.expires_after(milliseconds(50));
    timer_.async_wait([this](const Error&) {
      const auto now = std::chrono::steady_clock::now();
      std::erase_if(hub_.clients, [](const auto& client) { return client.expired(); });
      if (!hub_.clients.empty()) hub_.last_seen = now;
      const double idle = std::chrono::duration<double>(now - hub_.last_seen).count();
      const bool is_idle = hub_.settings->idle_seconds && idle >= *hub_.settings->idle_seconds;
      if (is_idle || hub_.settings->stop()) return hub_.io.stop();
      watch();
    });
  }

  template <class Action>
  void for_clients(const Action& action) {
    for (const auto& weak : std::vector(hub_.clients)) {
      if (const auto client = weak.lock()) action(*client);
    }
  }

  /// Tells the clients that the server ends, and waits a moment for their answers.
  void close_all() {
    acceptor_.close();
    for_clients([](SocketClient& client) { client.close(websocket::close_code::normal); });
    hub_.io.restart();
    hub_.io.run_for(milliseconds(300));
    hub_.io.stop();
    // What is left is destroyed with the context, when the session may be gone.
    for_clients([](SocketClient& client) { client.forget_session(); });
  }

  Hub hub_;
  std::atomic<bool> posted_{false};
  asio::basic_socket_acceptor<Protocol> acceptor_{hub_.io};
  asio::steady_timer timer_{hub_.io};
};

bool has_web_server() { return true; }

WebServer::WebServer() : implementation_(std::make_unique<Implementation>()) {}
WebServer::~WebServer() = default;

void WebServer::notify() { implementation_->notify(); }

Status WebServer::serve(const ServerSettings& settings, ViewSession& session) {
  return implementation_->serve(settings, session);
}

}  // namespace boule::view
