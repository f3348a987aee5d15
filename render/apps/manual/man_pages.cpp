#include "render/apps/manual/man_pages.h"

#include <algorithm>
#include <sstream>

#include "render/apps/manual/completions.h"
#include "render/apps/manual/markdown.h"

namespace boule::manual {
namespace {

std::string bold(const std::string& text) { return "**" + literal(text) + "**"; }
std::string slanted(const std::string& text) { return "*" + literal(text) + "*"; }

/// "boule(1)" of "boule.1".
std::string reference(const std::string& page) {
  return bold(page.substr(0, page.size() - 2)) + "(" + page.back() + ")";
}

std::string described(const std::string& term, const std::string& meaning) {
  return term + "\n: " + meaning + "\n\n";
}

/// "-o, --output IMAGE" with its fonts.
std::string term_of(const OptionFacts& option) {
  const std::string letter = option.letter.empty() ? "" : bold("-" + option.letter) + ", ";
  const std::string value = option.value.empty() ? "" : " " + slanted(option.value);
  return letter + bold("--" + option.name) + value;
}

/// The shortest command line: the command, its positionals, the options that must be there.
std::string synopsis_of(const CommandFacts& command) {
  std::string line = bold("boule " + command.name);
  if (command.options.size() > 1) line += " \\[*options*\\]";
  for (const OptionFacts& positional : command.positionals) {
    const std::string name = slanted(positional.value) + (positional.repeated ? " ..." : "");
    line += " " + (positional.required ? name : "\\[" + name + "\\]");
  }
  for (const OptionFacts& option : command.options) {
    const std::string name = option.letter.empty() ? "--" + option.name : "-" + option.letter;
    if (option.required) line += " " + bold(name) + " " + slanted(option.value);
  }
  return line;
}

/// What an option does, and the names that it takes where neither tells them.
std::string meaning_of(const OptionFacts& option) {
  const std::vector<std::string>& words = option.takes.words;
  const auto is_told = [&option](const std::string& word) {
    return (option.value + option.text).find(word) != std::string::npos;
  };
  if (std::all_of(words.begin(), words.end(), is_told)) return literal(option.text);
  return literal(option.text + ". Names: " + joined(words, ", "));
}

/// The options of a command, under the headings of its help; those without one first.
std::string options_section(const CommandFacts& command) {
  std::vector<OptionFacts> options = command.options;
  const std::string none = "Options";
  std::stable_partition(options.begin(), options.end(),
                        [&](const OptionFacts& option) { return option.group == none; });
  std::string text, group = none;
  for (const OptionFacts& option : options) {
    if (option.group != group) text += "## " + literal(option.group) + "\n\n";
    group = option.group;
    text += described(term_of(option), meaning_of(option));
  }
  return text;
}

/// A section of docs/command_line.md. Its tables of options, and what announces them, are left out:
/// the options of the help say the same.
struct Section {
  std::vector<const CommandFacts*> commands;  ///< which head it; none: it is of all
  std::string page;                           ///< "boule-isa.1" of "isa, version, help"
  std::string text;                           ///< with its heading where it is of all
  std::string examples;                       ///< commands to try
};

Section section_of(const std::string& heading, const std::vector<CommandFacts>& commands) {
  Section section;
  std::istringstream words(heading.substr(3, heading.size() - 4));
  for (std::string word; std::getline(words >> std::ws, word, ',');) {
    for (const CommandFacts& command : commands) {
      if (command.name == word) section.commands.push_back(&command);
    }
  }
  if (section.commands.empty()) {
    section.text = page_piece(heading);
  } else {
    section.page = "boule-" + section.commands[0]->name + ".1";
  }
  return section;
}

std::vector<Section> sections_of(const std::string& document,
                                 const std::vector<CommandFacts>& commands) {
  const std::vector<std::string> pieces = pieces_of(document);
  const auto is_options = [&pieces](std::size_t i) {
    return i < pieces.size() && pieces[i].starts_with("| option |");
  };
  std::vector<Section> sections;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool announces = pieces[i].ends_with(":\n") && is_options(i + 1);
    if (pieces[i].starts_with("## ")) {
      sections.push_back(section_of(pieces[i], commands));
    } else if (!sections.empty() && !is_options(i) && !announces) {
      Section& section = sections.back();
      const bool is_example = !section.commands.empty() && pieces[i].starts_with("```sh");
      (is_example ? section.examples : section.text) += page_piece(pieces[i]);
    }
  }
  return sections;
}

/// The page that describes a command; empty: none does.
std::string page_of(const CommandFacts& command, const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    if (std::count(section.commands.begin(), section.commands.end(), &command) > 0)
      return section.page;
  }
  return "";
}

std::string head(const std::string& page, const std::string& what) {
  return "# NAME\n\n" + page.substr(0, page.size() - 2) + " - " + literal(what) + "\n\n";
}

std::string command_page(const Section& section) {
  std::string what = section.commands[0]->text, options;
  what.front() = static_cast<char>(what.front() - 'A' + 'a');
  std::vector<std::string> lines;
  for (const CommandFacts* command : section.commands) {
    lines.push_back(synopsis_of(*command));
    const bool has_own = command->options.size() > 1;  // besides --help
    if (has_own || command == section.commands[0]) options += options_section(*command);
  }
  std::string text = head(section.page, what) + "# SYNOPSIS\n\n" + joined(lines, "  \n") +
                     "\n\n# DESCRIPTION\n\n" + section.text + "# OPTIONS\n\n" + options;
  if (!section.examples.empty()) text += "# EXAMPLES\n\n" + section.examples;
  return text + "# EXIT STATUS\n\nSee " + reference("boule.1") + ".\n\n";
}

std::string program_page(const std::vector<Section>& sections,
                         const std::vector<CommandFacts>& commands) {
  std::string text = head("boule.1", "ray tracer for spheres and planes") +
                     "# SYNOPSIS\n\n**boule** *COMMAND* \\[*options*\\]\n\n# DESCRIPTION\n\n" +
                     literal(commands.front().text) + "\n\n# COMMANDS\n\n";
  for (const CommandFacts& command : commands) {
    if (!command.name.empty())
      text += described(synopsis_of(command),
                        literal(command.text) + ": " + reference(page_of(command, sections)));
  }
  text += "# OPTIONS\n\n" + options_section(commands.front());
  for (const Section& section : sections) {
    if (section.commands.empty()) text += section.text;
  }
  return text + "# ENVIRONMENT\n\n" +
         described(bold("BOULE_ISA"), "The instruction set, as the option `--isa`.") +
         described(bold("SOURCE_DATE_EPOCH"),
                   "The date in the header of pictures, in seconds since 1970 (0).");
}

std::string scene_page(const std::string& document) {
  std::string text = head("boule-scene.5", "scene files of Boule") + "# DESCRIPTION\n\n";
  for (const std::string& piece : pieces_of(document)) {
    if (!piece.starts_with("# ")) text += page_piece(piece);
  }
  return text;
}

std::string see_also(const std::string& page, const Pages& pages) {
  std::vector<std::string> others;
  for (const auto& [name, text] : pages) {
    if (name != page) others.push_back(reference(name));
  }
  return "# SEE ALSO\n\n" + joined(others, ", ") + "\n";
}

}  // namespace

Result<Pages> man_pages(const std::vector<CommandFacts>& commands, const std::string& command_line,
                        const std::string& scene_format) {
  const std::vector<Section> sections = sections_of(command_line, commands);
  for (const CommandFacts& command : commands) {
    if (!command.name.empty() && page_of(command, sections).empty())
      return Diagnostic::of("docs/command_line.md: no section is headed by the command " +
                            quote(command.name));
  }
  Pages pages{{"boule.1", program_page(sections, commands)}};
  for (const Section& section : sections) {
    if (!section.commands.empty()) pages.emplace_back(section.page, command_page(section));
  }
  pages.emplace_back("boule-scene.5", scene_page(scene_format));
  for (auto& [name, text] : pages) text += see_also(name, pages);
  return pages;
}

}  // namespace boule::manual
