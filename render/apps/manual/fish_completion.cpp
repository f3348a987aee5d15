#include <string_view>

#include "render/apps/manual/completions.h"

namespace boule::manual {
namespace {

std::string fish_string(std::string_view text) {
  std::string all = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') all += '\\';
    all += letter;
  }
  return all + "'";
}

/// The options of `complete` for a value.
std::string takes_of(const ValueFacts& facts) {
  if (facts.list)
    return " -x -a '(__fish_complete_list , \"printf \\\\\"%s\\\\n\\\\\" " +
           joined(facts.words, " ") + "\")'";
  if (!facts.words.empty()) return " -x -a " + fish_string(joined(facts.words, " "));
  if (!facts.endings.empty()) return " -x -a '(__boule_files " + joined(facts.endings, " ") + ")'";
  return " -x";
}

std::string option_line(const std::string& when, const OptionFacts& option) {
  return "complete -c boule -n '" + when + "'" +
         (option.letter.empty() ? "" : " -s " + option.letter) + " -l " + option.name +
         (option.value.empty() ? "" : takes_of(option.takes)) + " -d " + fish_string(option.text) +
         "\n";
}

}  // namespace

std::string fish_completion(const std::vector<CommandFacts>& commands,
                            const std::string& functions) {
  std::string text = functions, names;
  for (const CommandFacts& command : commands) names += command.name + " ";
  for (const CommandFacts& command : commands) {
    const bool is_program = command.name.empty();
    const std::string when = is_program ? "__boule_begins" : "__boule_in " + command.name;
    text += "\n";
    if (!is_program) {
      text += "complete -c boule -n __boule_begins -a " + command.name + " -d " +
              fish_string(command.text) + "\n";
    }
    for (const OptionFacts& option : command.options) text += option_line(when, option);
    for (const OptionFacts& positional : command.positionals) {
      const bool is_command = positional.value == "COMMAND";
      text += "complete -c boule -n '" + when + "'" +
              (is_command ? " -a '" + names + "'" : takes_of(positional.takes)) + "\n";
    }
  }
  return text;
}

}  // namespace boule::manual
