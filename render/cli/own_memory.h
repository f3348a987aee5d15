#pragma once

#include "core/base/error.h"

namespace boule::cli {

/// Takes the stack that this program needs, all at once: an error where a limit (ulimit -s, -v) is
/// in its way. Later it could only be found out by a crash.
Status take_stack();

/// Ends the program at once with the line that there is no memory for anything else to say, its
/// temporary file removed.
[[noreturn]] void leave_without_memory();

/// Makes the program end like that where an allocation fails in a place that exceptions
/// cannot leave: code of others, while it is loaded for instance.
void install_no_memory_handler();

}  // namespace boule::cli
