#include "render/apps/cli/options/look_options.h"

#include <string>

#include "render/apps/cli/options/option_kinds.h"
#include "render/apps/job/options/look_choices.h"
#include "render/apps/job/options/look_values.h"

namespace boule::cli {
namespace {

template <class... Headings>
void add_of(CLI::App& app, LookOptions& look, Headings... headings) {
  add_rows(app, look_choices(), look,
           [&](const auto& row) { return ((row.group == headings) || ...); });
}

}  // namespace

void add_file_options(CLI::App& app, LookOptions& look) {
  add_of(app, look, heading::particle_file);
}

void add_look_options(CLI::App& app, LookOptions& look) {
  start_group(app, look_heading);
  add_of(app, look, heading::particle_file, heading::look, heading::spheres, heading::colors,
         heading::bonds);
  app.get_option("--quick")->excludes("--look");
}

void add_shape_options(CLI::App& app, LookOptions& look) {
  start_group(app, look_heading);
  add_of(app, look, heading::particle_file, heading::spheres, heading::bonds);
}

std::optional<UsageError> check_look_options(const CLI::App& app, LookOptions& look) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group() != look_heading || option->count() == 0) continue;
    const std::string& name = option->get_lnames().front();
    if (look.first.empty()) look.first = "--" + name;
    look.given.push_back({name, option->get_expected_max() > 0 ? option->results().back() : ""});
  }
  const std::string help = "boule " + app.get_name() + " --help";
  const bool has_map = may_have_color_map(look.color);
  if (!look.map.empty() && !has_map) return UsageError{"--map needs --color COLUMN", help};
  if (look.range && !has_map) return UsageError{"--range needs --color COLUMN", help};
  return std::nullopt;
}

}  // namespace boule::cli
