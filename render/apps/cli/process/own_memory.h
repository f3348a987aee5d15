#pragma once

#include "core/base/error.h"

namespace boule::cli {

/// Takes all the stack that this program needs at its start. An error where a limit (ulimit -s, -v)
/// does not allow it; later the program would crash instead.
Status take_stack();

/// Ends the program at once with a line that it is out of memory, after removing its temporary
/// file.
[[noreturn]] void leave_without_memory();

/// To be called first in main(). The program ends with the line of leave_without_memory() also
/// where an allocation fails in code that exceptions cannot leave: while libraries are loaded, and
/// before main() begins. After this call only a std::bad_alloc counts as such a failure. Where a
/// thread cannot be created in such code, the program ends with a line of its own.
void begin_main();

}  // namespace boule::cli
