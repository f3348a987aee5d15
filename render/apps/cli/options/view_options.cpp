#include "render/apps/cli/options/view_options.h"

#include <string>

#include "render/apps/cli/options/option_kinds.h"
#include "render/apps/job/options/look_values.h"

namespace boule::cli {

void add_view_options(CLI::App& app, ViewCommand& view) {
  start_group(app, "Server");
  add_parsed(app, "--listen", view.address, parse_words, "an address in numbers", "ADDR",
             "Address to listen on (127.0.0.1: this machine only)");
  add_whole(app, "--port", view.port, 0, 65535, "Port, 0: one that is free (0)");
  app.add_flag("--embed", view.embed, "Let pages of others show the page in a frame: notebooks");
  app.add_flag("--open", view.open, "Open the page in the browser");
  add_parsed(app, "--socket", view.socket, parse_words, "a path", "PATH",
             "Listen at a socket in the file system instead, for ssh -L PORT:PATH");
  app.get_option("--socket")->excludes("--listen")->excludes("--open");
  add_parsed(app, "--idle", view.idle, parse_duration,
             "a time above 0 in ms, s, m or h, such as 10m", "TIME",
             "End when no page was open for so long (never)");
}

}  // namespace boule::cli
