#include <string_view>

#include "render/apps/manual/completions.h"

namespace boule::manual {
namespace {

/// "fast robust|" or "|.png .exr"; a list's words end with a comma.
std::string value_of(const ValueFacts& facts) {
  return joined(facts.words, " ") + (facts.list ? "," : "") + "|" + joined(facts.endings, " ");
}

std::string entry(const std::string& key, const std::string& text) {
  return "  ['" + key + "']='" + text + "'\n";
}

std::string name_of(const CommandFacts& command) {
  return command.name.empty() ? "-" : command.name;
}

std::string options_entry(const CommandFacts& command) {
  std::vector<std::string> names;
  for (const OptionFacts& option : command.options) {
    if (!option.letter.empty()) names.push_back("-" + option.letter);
    names.push_back("--" + option.name);
  }
  return entry(name_of(command), joined(names, " "));
}

std::string takes_of(const CommandFacts& command, const std::string& commands) {
  std::string text;
  for (const OptionFacts& option : command.options) {
    if (option.value.empty()) continue;
    for (const std::string& name : {"-" + option.letter, "--" + option.name}) {
      if (name != "-") text += entry(command.name + " " + name, value_of(option.takes));
    }
  }
  for (const OptionFacts& positional : command.positionals) {
    const bool is_command = positional.value == "COMMAND";
    text += entry(command.name, is_command ? commands + "|" : value_of(positional.takes));
  }
  return text;
}

}  // namespace

std::string bash_completion(const std::vector<CommandFacts>& commands,
                            const std::string& functions) {
  std::vector<std::string> names;
  std::string options, takes;
  for (const CommandFacts& command : commands) {
    if (!command.name.empty()) names.push_back(command.name);
  }
  for (const CommandFacts& command : commands) {
    options += options_entry(command);
    takes += takes_of(command, joined(names, " "));
  }
  return "# Completes boule in bash (4.3 or newer).\n_boule_commands='" + joined(names, " ") +
         "'\ndeclare -gA _boule_options=(\n" + options + ")\ndeclare -gA _boule_takes=(\n" + takes +
         ")\n" + functions;
}

}  // namespace boule::manual
