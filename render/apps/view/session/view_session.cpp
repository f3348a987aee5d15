#include "render/apps/view/session/view_session.h"

#include <utility>

#include "render/apps/view/messages/client_message.h"
#include "render/apps/view/session/audience.h"
#include "render/apps/view/session/mailbox.h"
#include "render/apps/view/session/picture_store.h"
#include "render/apps/view/session/state_text.h"
#include "render/apps/view/session/view_loop.h"
#include "render/threads/threads.h"

namespace boule::view {
namespace {

const char* type_of(const ClientMessage& message) {
  constexpr const char* types[] = {"camera", "settings",    "particles", "frame", "pick",
                                   "save",   "stop_saving", "texts",     "ack"};
  static_assert(std::variant_size_v<ClientMessage> == std::size(types));
  return types[message.index()];
}

std::optional<std::uint32_t> id_of(const ClientMessage& message) {
  return std::visit(
      [](const auto& any) -> std::optional<std::uint32_t> {
        if constexpr (requires { any.id; }) return any.id;
        return std::nullopt;
      },
      message);
}

}  // namespace

struct ViewSession::Parts {
  Audience audience;
  PictureStore pictures;
  std::unique_ptr<Mailbox> mailbox;
  std::unique_ptr<ViewLoop> loop;

  explicit Parts(std::function<void()> notify) : audience(std::move(notify)) {}
};

Result<std::unique_ptr<ViewSession>> ViewSession::open(SceneSource& source, LoadedScene loaded,
                                                       SessionSettings settings,
                                                       std::function<void()> notify) {
  const SourceFacts& facts = source.facts();
  auto parts = std::make_unique<Parts>(std::move(notify));
  Wish wish{0, {}, 0, settings.view, facts.look, facts.first_frame};
  // The mailbox is made once the camera is known, and the loop before it.
  Mailbox::Limits limits{settings.view.panes.front(), facts.kind == "particles", facts.frames};
  parts->mailbox = std::make_unique<Mailbox>(wish, limits);
  parts->loop = std::make_unique<ViewLoop>(
      LoopParts{source, *parts->mailbox, parts->audience, parts->pictures, settings.token,
                settings.longest_absence},
      settings.work);
  if (auto done = parts->loop->open(std::move(loaded), wish); !done) return done.error();
  parts->mailbox->correct(wish);
  auto session = std::unique_ptr<ViewSession>(new ViewSession(std::move(parts)));
  if (session->thread_->size() == 0) return Diagnostic::of("no thread can be had to render on");
  return session;
}

ViewSession::ViewSession(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {
  thread_ = std::make_unique<Threads>(1, [this](std::size_t) { parts_->loop->run(); });
}

ViewSession::~ViewSession() { parts_->mailbox->stop(); }

int ViewSession::connect() {
  const int client = parts_->audience.join();
  parts_->mailbox->connect();
  return client;
}

void ViewSession::disconnect(int client) {
  parts_->audience.leave(client);
  parts_->mailbox->wake();
}

void ViewSession::receive(int client, std::string_view text) {
  auto read = read_message(text);
  if (const auto* refused = std::get_if<RefusedMessage>(&read)) {
    return parts_->audience.answer(client, error_text(refused->type, refused->error, refused->id));
  }
  auto& message = std::get<ClientMessage>(read);
  std::visit(
      [client](auto& any) {
        if constexpr (requires { any.client; }) any.client = client;
      },
      message);
  if (const auto* ack = std::get_if<AckMessage>(&message)) {
    if (const auto outbox = parts_->audience.outbox(client)) outbox->acknowledge(ack->frame);
  }
  if (const auto done = parts_->mailbox->take(message); !done)
    parts_->audience.answer(client, error_text(type_of(message), done.error(), id_of(message)));
}

const Audience& ViewSession::audience() { return parts_->audience; }
const PictureStore& ViewSession::pictures() { return parts_->pictures; }

}  // namespace boule::view
