#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/apps/view/server/web_server.h"
#include "render/apps/view/session/scene_source.h"
#include "render/apps/view/session/view_session.h"
#include "render/threads/threads.h"
#include "tests/render/apps/view/view_client.h"

namespace boule::test {

/// A scene in memory, the same in every frame.
class FixedSource final : public view::SceneSource {
 public:
  explicit FixedSource(Scene scene) : scene_(std::move(scene)) {
    facts_.path = "test.toml";
    facts_.kind = "toml";
  }
  [[nodiscard]] const view::SourceFacts& facts() const override { return facts_; }
  Result<LoadedScene> load(const view::ParticleLook&, int) override {
    return LoadedScene{scene_, {}};
  }
  std::vector<view::NumberRange> columns() override { return {}; }
  [[nodiscard]] std::string options_of(const view::ParticleLook&, int) const override { return {}; }

 private:
  Scene scene_;
  view::SourceFacts facts_;
};

inline view::ViewSettings settings_of(const Scene& scene) {
  view::ViewSettings settings;
  settings.width = scene.image.width;
  settings.height = scene.image.height;
  settings.spp = scene.image.spp;
  settings.max_depth = scene.render.max_depth;
  settings.panes[0].method = scene.render.method;
  return settings;
}

/// A server of a scene, on a thread of its own until it goes.
class RunningServer {
 public:
  explicit RunningServer(const Scene& scene, std::optional<double> idle_seconds = {},
                         std::chrono::milliseconds longest_absence = std::chrono::seconds(10))
      : source_(scene) {
    const std::string token = "0123456789abcdef0123456789abcdef";
    view::SessionSettings session;
    session.view = settings_of(scene);
    session.token = token;
    session.longest_absence = longest_absence;
    session_ =
        std::move(view::ViewSession::open(source_, source_.load({}, 0).value(), session, [this] {
          server_.notify();
        })).value();
    settings_.token = token;
    settings_.idle_seconds = idle_seconds;
    settings_.stop = [this] { return stop_.load(); };
    settings_.ready = [this](const std::string& url) {
      url_ = url;
      ready_ = true;
      ready_.notify_all();
    };
    thread_ = std::make_unique<Threads>(1, [this](std::size_t) {
      status_ = server_.serve(settings_, *session_);
      ended_ = true;
    });
    ready_.wait(false);
  }
  ~RunningServer() { static_cast<void>(stop()); }

  [[nodiscard]] ServerPlace place() const { return ServerPlace(url_); }
  [[nodiscard]] bool ended() const { return ended_; }
  /// Ends it, and returns what serve() did.
  Status stop() {
    stop_ = true;
    thread_.reset();
    return status_;
  }

 private:
  FixedSource source_;
  view::WebServer server_;  ///< before the session, which notifies it
  std::unique_ptr<view::ViewSession> session_;
  view::ServerSettings settings_;
  std::string url_;
  std::atomic<bool> ready_{false}, stop_{false}, ended_{false};
  Status status_;
  std::unique_ptr<Threads> thread_;
};

}  // namespace boule::test
