#include "render/apps/manual/command_facts.h"

#include "render/apps/cli/options/command_app.h"
#include "render/apps/manual/value_facts.h"

namespace boule::manual {
namespace {

OptionFacts facts_of(const CLI::Option& option) {
  OptionFacts facts;
  facts.text = option.get_description();
  facts.group = option.get_group();
  facts.required = option.get_required();
  facts.repeated = option.get_items_expected_max() > 1;
  if (option.get_positional()) {
    facts.value = option.get_name(true);
  } else {
    facts.name = option.get_lnames().front();
    if (!option.get_snames().empty()) facts.letter = option.get_snames().front();
    facts.value = option.get_type_name();
  }
  if (!facts.value.empty()) facts.takes = value_facts(facts);
  return facts;
}

CommandFacts facts_of(const CLI::App& app) {
  CommandFacts facts;
  facts.name = app.get_parent() == nullptr ? "" : app.get_name();
  facts.text = app.get_description();
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? facts.positionals : facts.options).push_back(facts_of(*option));
  return facts;
}

}  // namespace

std::vector<CommandFacts> command_facts() {
  std::vector<CommandFacts> commands;
  cli::visit_commands([&commands](const CLI::App& app) {
    commands.push_back(facts_of(app));
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(facts_of(*command));
  });
  return commands;
}

}  // namespace boule::manual
