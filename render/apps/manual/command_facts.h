#pragma once

#include <string>
#include <vector>

namespace boule::manual {

/// What can stand in place of an option's or a positional's value.
struct ValueFacts {
  std::vector<std::string> words;    ///< names; empty: anything
  std::vector<std::string> endings;  ///< of files, with their dots; empty: no file
  bool list = false;                 ///< several words, with commas between them
};

/// An option, or a positional, which has neither letter nor name.
struct OptionFacts {
  std::string letter;     ///< "o" of -o; may be empty
  std::string name;       ///< "output" of --output
  std::string value;      ///< what its value is called, such as "IMAGE"; empty: it has none
  std::string text;       ///< what it does
  std::string group;      ///< the heading that it stands under
  bool required = false;  ///< a command line without it is refused
  bool repeated = false;  ///< takes any number of values
  ValueFacts takes;
};

/// A command, or the program itself, whose name is empty.
struct CommandFacts {
  std::string name;
  std::string text;  ///< what it does
  std::vector<OptionFacts> positionals;
  std::vector<OptionFacts> options;  ///< in the order of the help, --help first
};

/// The program first, then its commands, as the command line has them.
std::vector<CommandFacts> command_facts();

}  // namespace boule::manual
