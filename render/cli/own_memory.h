#pragma once

#include "core/base/error.h"

namespace boule::cli {

/// Takes the stack that this program needs, all at once: an error where a limit (ulimit -s, -v) is
/// in its way. Later it could only be found out by a crash.
Status take_stack();

/// Ends the program at once with the line that there is no memory for anything else to say, its
/// temporary file removed.
[[noreturn]] void leave_without_memory();

/// The program ends like that, too, where an allocation fails in a place that exceptions cannot
/// leave: code of others while it is loaded, and before main() begins. This says that it has: from
/// then on it takes a std::bad_alloc to end so; and likewise, with a line of its own, where a
/// thread cannot be had there.
void begin_main();

}  // namespace boule::cli
