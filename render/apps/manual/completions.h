#pragma once

#include <string>
#include <vector>

#include "core/base/text.h"
#include "render/apps/manual/command_facts.h"

namespace boule::manual {

/// Scripts that complete command lines: commands, options, the names that are values of options,
/// and the files that fit, by their endings. Where no file fits, all are offered.
/// `functions` is what the shell runs, functions.bash or functions.fish.
std::string bash_completion(const std::vector<CommandFacts>& commands,
                            const std::string& functions);
std::string zsh_completion(const std::vector<CommandFacts>& commands);
std::string fish_completion(const std::vector<CommandFacts>& commands,
                            const std::string& functions);

}  // namespace boule::manual
