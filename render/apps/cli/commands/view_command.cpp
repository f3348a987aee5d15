#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/commands/view_source.h"
#include "render/apps/cli/process/file_lock.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/reading_limit.h"
#include "render/apps/job/scene_loader.h"
#include "render/apps/view/server/access.h"
#include "render/apps/view/server/web_server.h"
#include "render/apps/view/session/view_session.h"
#include "render/image/image_start.h"
#include "render/renderer/renderer.h"

extern char** environ;

namespace boule::cli {
namespace {

/// What the page shows at first: as the scene and the command line say.
view::ViewSettings first_settings(const RenderCommand& command, const Scene& scene) {
  view::ViewSettings settings;
  settings.width =
      std::min(command.size ? command.size->width : scene.image.width, view::max_view_side);
  settings.height =
      std::min(command.size ? command.size->height : scene.image.height, view::max_view_side);
  settings.spp = std::min(command.spp.value_or(scene.image.spp), view::max_view_spp);
  settings.max_depth =
      std::min(command.max_depth.value_or(scene.render.max_depth), view::max_view_depth);
  const RenderOptions options = options_of(command, scene);
  settings.outline = options.outline;
  settings.fog = options.fog;
  settings.panes = {{command.order.value_or(PixelOrder::progressive), command.solver,
                     command.method.value_or(scene.render.method), command.shadow_epsilon}};
  return settings;
}

/// Opens an address in the browser, as the desktop does; a note if that fails.
void open_browser(const std::string& url) {
  std::string program = "xdg-open", address = url;
  char* const arguments[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) != 0) {
    print_note("boule: note: xdg-open is missing, which --open needs: open the address yourself");
    return;
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (status != 0) print_note("boule: note: the browser could not be opened");
}

/// Who has logged in by ssh cannot open this machine's own address, and nobody a socket in the file
/// system: a note how a tunnel does it.
void tell_tunnel(const std::string& url, const std::string& socket) {
  const char* const connection = std::getenv("SSH_CONNECTION");  // client, port, server, port
  const std::string host = socket.empty() ? "127.0.0.1:" : "localhost:";
  const std::size_t at = url.find(host);
  if (at == std::string::npos || (connection == nullptr && socket.empty())) return;
  std::istringstream words(connection == nullptr ? "- - HOST 22" : connection);
  std::string client, client_port, server, server_port;
  if (!(words >> client >> client_port >> server >> server_port)) return;
  const std::size_t digits = at + host.size();
  const std::string port = url.substr(digits, url.find('/', digits) - digits);
  const std::string far =
      socket.empty() ? host + port : std::filesystem::absolute(socket).lexically_normal().string();
  const std::string way = port + ":" + far;
  const bool is_plain = std::all_of(way.begin(), way.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("/._-:").find(static_cast<char>(c)) != std::string_view::npos;
  });
  print_note("boule: note: to open it on the machine that you came from, run there: ssh -N -L " +
             printable(is_plain ? way : shell_word(way)) +
             (server_port == "22" ? "" : " -p " + server_port) + " " + printable(server));
}

ExitCode serve(const ViewCommand& command, view::WebServer& server, view::ViewSession& session,
               const std::string& token) {
  Status written;
  view::ServerSettings settings;
  settings.address = command.address;
  settings.port = static_cast<unsigned short>(command.port);
  settings.socket = command.socket;
  settings.token = token;
  settings.embed = command.embed;
  settings.idle_seconds = command.idle;
  settings.stop = [&written] { return StopGuard::flag() || !written.ok(); };
  settings.ready = [&](const std::string& url) {
    written = print_data(url + "\n");
    if (reader_left()) leave_unread();
    tell_tunnel(url, command.socket);
    if (written && command.open) open_browser(url);
  };
  // Before a socket in the file system is looked at: two servers would remove each other's.
  std::optional<FileLock> lock;
  if (!command.socket.empty()) {
    auto taken = FileLock::take(command.socket + ".lock");
    if (!taken) return report(taken.error(), failed);
    lock = std::move(taken).value();
  }
  const StopGuard guard(OnSignal::stop);
  if (const auto done = server.serve(settings, session); !done)
    return report(done.error(), done.error().key.empty() ? failed : wrong_usage);
  if (!written) return report(written.error(), failed);
  if (StopGuard::caught() == 0) return done;
  print_note(std::string("boule: ended (") + StopGuard::caught_name() + ")");
  return interrupted_by(StopGuard::caught());
}

}  // namespace

ExitCode run(const ViewCommand& command) {
  if (!view::has_web_server())
    return report(Diagnostic::of("this build has no server: it was made without Boost.Beast"),
                  failed);
  const RenderCommand& render = command.render;
  const auto token = view::random_token();
  if (!token) return report(token.error(), failed);
  // Loaded beside the scene, so that the first finished picture need not wait for it.
  ImageStart image_start("view.png", 1);
  ViewSource source(render);
  ReadingLimit limit(render.load_limit);
  Result<LoadedScene> loaded = Diagnostic::of("");
  {
    const ReadingLimit::Reading reading(limit, render.scene);
    if (auto done = source.open(); !done)
      return report(done.error(), code_of_loading(done.error()));
    loaded = source.load(source.facts().look, source.facts().first_frame);
  }
  if (!loaded) return report(loaded.error(), code_of_loading(loaded.error()));
  for (const std::string& warning : loaded.value().warnings) print_note(warning);
  const view::SessionSettings settings{
      first_settings(render, loaded.value().scene), {render.threads, render.isa}, token.value()};
  view::WebServer server;
  auto session = view::ViewSession::open(source, std::move(loaded).value(), settings,
                                         [&server] { server.notify(); });
  if (!session) return report(session.error(), failed);
  if (auto done = image_start.wait(); !done) return report(done.error(), failed);
  return serve(command, server, *session.value(), token.value());
}

}  // namespace boule::cli
