#pragma once

#include "render/apps/manual/command_facts.h"

namespace boule::manual {

/// What an option takes as its value, from how its value is called and described, and from the
/// lists that the command line checks it by. Takes an option without `takes`.
ValueFacts value_facts(const OptionFacts& option);

}  // namespace boule::manual
