#include <string_view>

#include "render/apps/manual/completions.h"

namespace boule::manual {
namespace {

/// Characters that _arguments takes for its own, and the quote that ends a word.
std::string escaped(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '\'') {
      escaped += "'\\''";
    } else {
      if (std::string_view("[]:\\").find(letter) != std::string_view::npos) escaped += '\\';
      escaped += letter;
    }
  }
  return escaped;
}

/// What fits: names, files by their endings (all where none fits), or a message only.
std::string action_of(const ValueFacts& facts) {
  if (facts.list) return "_values -s , name " + joined(facts.words, " ");
  if (!facts.words.empty()) return "(" + joined(facts.words, " ") + ")";
  if (facts.endings.empty()) return " ";
  std::vector<std::string> endings;
  for (const std::string& ending : facts.endings) endings.push_back(ending.substr(1));
  return "_files -g \"*.(" + joined(endings, "|") + ")(-.)\"";
}

std::string option_line(const OptionFacts& option) {
  const std::string value =
      option.value.empty() ? "" : ":" + escaped(option.value) + ":" + action_of(option.takes);
  const std::string what = "[" + escaped(option.text) + "]" + value;
  const std::string name = "--" + option.name + (option.value.empty() ? "" : "=");
  const std::string also = option.letter.empty() ? "" : "-" + option.letter;
  if (also.empty()) return "        '" + name + what + "' \\\n";
  return "        '(" + also + " --" + option.name + ")'{" + also +
         (option.value.empty() ? "" : "+") + "," + name + "}'" + what + "' \\\n";
}

std::string positional_line(const OptionFacts& positional) {
  const bool is_command = positional.value == "COMMAND";
  const std::string place = positional.repeated ? "*" : positional.required ? "1" : "1:";
  return "        '" + place + ":" + escaped(positional.value) + ":" +
         (is_command ? "_boule_commands" : action_of(positional.takes)) + "' \\\n";
}

std::string arguments_of(const CommandFacts& command) {
  std::string lines = "      _arguments -s -S \\\n";
  for (const OptionFacts& option : command.options) lines += option_line(option);
  for (const OptionFacts& positional : command.positionals) lines += positional_line(positional);
  return lines.substr(0, lines.size() - 3) + "\n";
}

}  // namespace

std::string zsh_completion(const std::vector<CommandFacts>& commands) {
  std::string names, cases;
  for (const CommandFacts& command : commands) {
    if (command.name.empty()) continue;
    names += "    '" + command.name + ":" + escaped(command.text) + "'\n";
    cases += "    " + command.name + ")\n" + arguments_of(command) + "      ;;\n";
  }
  return "#compdef boule\n# Completes boule in zsh.\n\n_boule_commands() {\n  local -a "
         "commands=(\n" +
         names + "  )\n  _describe -t commands command commands\n}\n\n_boule() {\n" +
         "  if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then\n    _boule_commands\n    return\n"
         "  fi\n  local command=$words[2]\n  shift words\n  ((CURRENT--))\n  case $command in\n" +
         cases + "    *)\n" + arguments_of(commands.front()) +
         "      ;;\n  esac\n}\n\n_boule \"$@\"\n";
}

}  // namespace boule::manual
