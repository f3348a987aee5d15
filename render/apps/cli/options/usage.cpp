#include "render/apps/cli/options/usage.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "render/files/file/nearest_name.h"
#include "render/files/particle_file/particle_file.h"

namespace boule::cli {
namespace {

using Names = std::vector<std::string>;

std::string suggest(const std::string& name, const Names& known) {
  return did_you_mean(name, std::vector<std::string_view>(known.begin(), known.end()));
}

Names command_names(const CLI::App& app) {
  Names names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

bool is_option_word(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

/// An option or positional by the name that is quickest to type.
std::string short_name(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true);
  return option.get_snames().empty() ? "--" + option.get_lnames().front()
                                     : "-" + option.get_snames().front();
}

/// The required options and positionals that are not there.
std::vector<const CLI::Option*> missing_options(const CLI::App& command) {
  // Of what trace can be asked about, rays are the most usual.
  const auto is_question = [&](const CLI::Option* option) {
    return option->get_name() == "--rays" && command.count("--points") == 0 &&
           command.count("--pairs") == 0;
  };
  return command.get_options([&](const CLI::Option* option) {
    return option->count() == 0 && (option->get_required() || is_question(option));
  });
}

/// The options of a command, those that must be there first: they are the likeliest to be meant.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  auto options = command.get_options();
  std::stable_partition(options.begin(), options.end(),
                        [](const CLI::Option* option) { return option->get_required(); });
  return options;
}

/// "'-o' (--output)": how an option is called whose name begins as `name` does.
std::string both_names(const CLI::Option& option, const std::string& name) {
  const std::string quickest = short_name(option);
  return quote(quickest) + (quickest == name ? "" : " (" + name + ")");
}

std::string unknown_option(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const std::string text = "unknown option " + quote(name);
  Names known;
  for (const CLI::Option* option : options_of(command)) {
    for (const std::string& one : option->get_lnames()) {
      // Many programs accept the beginning of an option's name: it is not a misspelling of another.
      const bool is_start = name.size() > 3 && ("--" + one).starts_with(name);
      if (is_start) return text + "; did you mean " + both_names(*option, "--" + one) + "?";
      known.push_back("--" + one);
    }
  }
  const bool is_letter = name.size() < 3;  // any other letter would be as near
  return is_letter ? text : text + suggest(name, known);
}

/// A word before any command that is neither one nor an option of the program.
UsageError explain_early(const CLI::App& app, const std::string& word) {
  if (!is_option_word(word)) return unknown_command(app, word);
  const std::string name = word.substr(0, word.find('='));
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_option_no_throw(name) == nullptr) continue;
    return {"option " + quote(name) + " belongs behind a command, such as " +
            quote(command->get_name())};
  }
  return {unknown_option(app, word)};
}

/// The error for a word that no option takes; it names the missing options, which may be meant.
std::string unexpected(const CLI::App& command, const std::string& word) {
  std::string text = "argument not expected: " + quote(word), names;
  for (const CLI::Option* option : missing_options(command)) {
    if (!option->get_positional())
      names += (names.empty() ? "" : " or ") + quote(short_name(*option));
  }
  return names.empty() ? text : text + "; is " + names + " missing before it?";
}

/// "-o IMAGE is missing".
std::string missing(const CLI::App& app, const CLI::App& command) {
  if (&command == &app) {
    return "a command is missing, expected " +
           list_names({"render", "view", "pack", "merge", "scene", "trace", "info", "isa"});
  }
  const CLI::Option& option = *missing_options(command).front();
  const std::string& type = option.get_type_name();
  return short_name(option) + (type.empty() ? "" : " " + type) + " is missing";
}

/// "--size is given 2 times": of options that are to be given once; empty if there is none.
std::string repeated(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const bool is_flag = option->get_items_expected_max() == 0;  // may be repeated
    if (!is_flag && option->count() > static_cast<std::size_t>(option->get_items_expected_max()))
      return option->get_name() + " is given " + std::to_string(option->count()) + " times";
  }
  return {};
}

}  // namespace

UsageError unknown_command(const CLI::App& app, const std::string& name) {
  const std::string text = "unknown command " + quote(name);
  const bool is_scene = name.ends_with(".toml") || name.ends_with(".nff") ||
                        name.ends_with(".npy") || name.ends_with(".boule") ||
                        is_particle_name(name);
  if (is_scene) return {text + "; did you mean 'boule render " + safe_name(name) + "'?"};
  return {text + suggest(name, command_names(app))};
}

UsageError explain_usage(const CLI::App& app, const CLI::ParseError& error) {
  const bool is_missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const Names early = app.remaining(false);
  if (!early.empty() && (is_missing || is_extra)) return explain_early(app, early.front());
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::string help =
      chosen.empty() ? "boule --help" : "boule " + command.get_name() + " --help";
  const Names words = command.remaining();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    if (std::string text = repeated(command); !text.empty()) return {std::move(text), help};
  }
  if (words.empty() || (!is_missing && !is_extra)) {
    // CLI11's message repeats what was typed, so it is made printable.
    return {is_missing ? missing(app, command) : printable(error.what(), 400), help};
  }
  const auto option = std::find_if(words.begin(), words.end(), is_option_word);
  return {
      option != words.end() ? unknown_option(command, *option) : unexpected(command, words.front()),
      help};
}

}  // namespace boule::cli
