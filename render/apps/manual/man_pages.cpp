#include "render/apps/manual/man_pages.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "render/apps/manual/markdown.h"
#include "render/apps/manual/roff.h"

namespace boule::manual {
namespace {

using Blocks = std::vector<Block>;

std::string bold(const std::string& roff) { return "\\fB" + roff + "\\fP"; }
std::string slanted(const std::string& roff) { return "\\fI" + roff + "\\fP"; }

std::string reference(const std::string& page, int section) {
  return bold(roff_literal(page)) + "(" + std::to_string(section) + ")";
}

/// The name of a page as the page's first lines have it.
std::string head(const std::string& page, int section, const std::string& what,
                 const ManualSources& sources) {
  std::string title = roff_literal(page);
  std::transform(title.begin(), title.end(), title.begin(), [](char letter) {
    return letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  });
  return ".TH " + title + " " + std::to_string(section) + " " + sources.date + " \"boule " +
         sources.version + "\" \"Boule manual\"\n.nh\n.ad l\n.SH NAME\n" + roff_literal(page) +
         " \\- " + roff_text(what) + "\n";
}

/// "-o, --output IMAGE" with its fonts.
std::string term_of(const OptionFacts& option) {
  std::string term = option.letter.empty() ? "" : bold("\\-" + roff_literal(option.letter)) + ", ";
  term += bold("\\-\\-" + roff_literal(option.name));
  return option.value.empty() ? term : term + " " + slanted(roff_literal(option.value));
}

/// The shortest command line: the command, its positionals, the options that must be there.
std::string synopsis_of(const CommandFacts& command) {
  std::string line = bold(roff_literal("boule " + command.name));
  if (command.options.size() > 1) line += " [" + slanted("options") + "]";
  for (const OptionFacts& positional : command.positionals) {
    const std::string name =
        slanted(roff_literal(positional.value)) + (positional.repeated ? " ..." : "");
    line += " " + (positional.required ? name : "[" + name + "]");
  }
  for (const OptionFacts& option : command.options) {
    if (!option.required) continue;
    const std::string name = option.letter.empty() ? "\\-\\-" + option.name : "\\-" + option.letter;
    line += " " + bold(name) + " " + slanted(roff_literal(option.value));
  }
  return line;
}

/// What an option does, and the names that it takes where neither tells them.
std::string meaning_of(const OptionFacts& option) {
  const std::vector<std::string>& words = option.takes.words;
  const auto is_told = [&option](const std::string& word) {
    return (option.value + option.text).find(word) != std::string::npos;
  };
  if (std::all_of(words.begin(), words.end(), is_told)) return roff_literal(option.text);
  std::string names;
  for (const std::string& word : words) names += (names.empty() ? "" : ", ") + word;
  return roff_literal(option.text + ". Names: " + names);
}

/// The options of a command, under the headings of its help.
std::string options_section(const CommandFacts& command) {
  std::vector<std::string> groups;
  for (const OptionFacts& option : command.options) {
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end())
      groups.push_back(option.group);
  }
  std::string roff;
  for (const std::string& group : groups) {
    if (groups.size() > 1 && group != "Options") roff += ".SS " + roff_literal(group) + "\n";
    for (const OptionFacts& option : command.options) {
      if (option.group == group) roff += roff_entry(term_of(option), meaning_of(option));
    }
  }
  return roff;
}

/// The words of a heading: "isa, version, help".
std::vector<std::string> words_of(const std::string& heading) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= heading.size();) {
    const std::size_t end = std::min(heading.find(", ", at), heading.size());
    words.push_back(heading.substr(at, end - at));
    at = end + 2;
  }
  return words;
}

/// A section of docs/command_line.md, with the commands that head it; none: it is of all.
struct Section {
  std::string heading;
  std::vector<const CommandFacts*> commands;
  Blocks blocks;
};

std::vector<Section> sections_of(const Blocks& page, const std::vector<CommandFacts>& commands) {
  std::vector<Section> sections;
  for (const Block& block : page) {
    if (block.kind != BlockKind::heading || block.level != 2) continue;
    Section section{block.text, {}, section_of(page, 2, block.text)};
    for (const std::string& word : words_of(block.text)) {
      for (const CommandFacts& command : commands) {
        if (!word.empty() && command.name == word) section.commands.push_back(&command);
      }
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

/// The section's tables of options say what the options of the help say.
bool is_option_table(const Block& block) {
  return block.kind == BlockKind::table && block.rows.front().front() == "option";
}

/// Blocks that are commands to try, or the others but for tables of options and what announces
/// them.
Blocks blocks_of(const Section& section, bool examples) {
  Blocks blocks;
  for (const Block& block : section.blocks) {
    const bool announced = !blocks.empty() && blocks.back().text.ends_with(':');
    if (is_option_table(block) && announced) blocks.pop_back();
    const bool is_example = block.kind == BlockKind::code && block.text == "sh";
    if (is_example == examples && !is_option_table(block)) blocks.push_back(block);
  }
  return blocks;
}

std::string page_name(const Section& section) { return "boule-" + section.commands[0]->name; }

std::string see_also(const std::vector<Section>& sections, const std::string& page) {
  std::string list;
  const auto add = [&](const std::string& name, int part) {
    if (name != page) list += (list.empty() ? "" : ", ") + reference(name, part);
  };
  add("boule", 1);
  for (const Section& section : sections) {
    if (!section.commands.empty()) add(page_name(section), 1);
  }
  add("boule-scene", 5);
  return ".SH SEE ALSO\n" + roff_lines(list);
}

ManualFile command_page(const Section& section, const std::vector<Section>& sections,
                        const ManualSources& sources) {
  const std::string name = page_name(section);
  std::string what = section.commands[0]->text;
  what.front() = static_cast<char>(what.front() - 'A' + 'a');
  std::string text = head(name, 1, what, sources) + ".SH SYNOPSIS\n", options;
  for (const CommandFacts* command : section.commands) {
    text += (command == section.commands[0] ? "" : ".br\n") + synopsis_of(*command) + "\n";
    const bool has_own = command->options.size() > 1;  // besides --help
    if (has_own || command == section.commands[0]) options += options_section(*command);
  }
  text += ".SH DESCRIPTION\n" + roff_blocks(blocks_of(section, false), 2);
  text += ".SH OPTIONS\n" + options;
  const Blocks examples = blocks_of(section, true);
  if (!examples.empty()) text += ".SH EXAMPLES\n" + roff_blocks(examples, 2);
  text += ".SH EXIT STATUS\nSee " + reference("boule", 1) + ".\n";
  return {name + ".1", text + see_also(sections, name)};
}

/// The list of commands in boule(1), each with its page.
std::string commands_of(const std::vector<Section>& sections,
                        const std::vector<CommandFacts>& commands) {
  std::string roff;
  for (const CommandFacts& command : commands) {
    for (const Section& section : sections) {
      const bool has_page = !section.commands.empty() && section.commands[0] == &command;
      if (has_page)
        roff += roff_entry(synopsis_of(command),
                           roff_literal(command.text) + ": " + reference(page_name(section), 1));
    }
  }
  for (const CommandFacts& command : commands) {
    if (command.name == "help" || command.name == "version")
      roff += roff_entry(synopsis_of(command), roff_literal(command.text));
  }
  return roff;
}

ManualFile program_page(const std::vector<Section>& sections,
                        const std::vector<CommandFacts>& commands, const ManualSources& sources) {
  std::string text = head("boule", 1, "ray tracer for spheres and planes", sources);
  text += ".SH SYNOPSIS\n" + bold("boule") + " " + slanted("COMMAND") + " [" + slanted("options") +
          "]\n.SH DESCRIPTION\n" + roff_lines(roff_literal(commands.front().text));
  text += ".SH COMMANDS\n" + commands_of(sections, commands);
  text += ".SH OPTIONS\n" + options_section(commands.front());
  for (const Section& section : sections) {
    if (!section.commands.empty()) continue;
    text += roff_blocks({{BlockKind::heading, 2, section.heading, {}, {}}}, 2);
    text += roff_blocks(section.blocks, 2);
  }
  text += ".SH ENVIRONMENT\n";
  text += roff_entry(bold("BOULE_ISA"), roff_text("The instruction set, as the option `--isa`."));
  text += roff_entry(bold("SOURCE_DATE_EPOCH"),
                     roff_text("The date in the header of pictures, in seconds since 1970 (0)."));
  return {"boule.1", text + see_also(sections, "boule")};
}

ManualFile scene_page(const std::vector<Section>& sections, const ManualSources& sources) {
  Blocks blocks = parse_markdown(sources.scene_format);
  blocks.erase(blocks.begin());  // the title
  std::string text = head("boule-scene", 5, "scene files of Boule", sources);
  text += ".SH DESCRIPTION\n" + roff_blocks(blocks, 2);
  return {"boule-scene.5", text + see_also(sections, "")};
}

}  // namespace

Result<std::vector<ManualFile>> man_pages(const std::vector<CommandFacts>& commands,
                                          const ManualSources& sources) {
  const std::vector<Section> sections = sections_of(parse_markdown(sources.command_line), commands);
  for (const CommandFacts& command : commands) {
    const bool found = std::any_of(sections.begin(), sections.end(), [&](const Section& section) {
      return std::count(section.commands.begin(), section.commands.end(), &command) > 0;
    });
    if (!found && !command.name.empty())
      return Diagnostic::of("docs/command_line.md: no section is headed by the command " +
                            quote(command.name));
  }
  std::vector<ManualFile> pages{program_page(sections, commands, sources)};
  for (const Section& section : sections) {
    if (!section.commands.empty()) pages.push_back(command_page(section, sections, sources));
  }
  pages.push_back(scene_page(sections, sources));
  return pages;
}

}  // namespace boule::manual
