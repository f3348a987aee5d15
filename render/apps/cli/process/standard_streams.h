#pragma once

namespace boule::cli {

/// Opens those of the descriptors 0, 1 and 2 that are closed. Otherwise the next file that is
/// opened would become standard output or error, and get the text meant for them. To be called
/// before any file is opened.
void open_closed_streams();

/// Ends the program with an exit code, after writing what the C streams still hold. Static objects
/// are not destroyed: those of OpenImageIO crash where a thread of theirs could not be started.
/// With a sanitizer they are, because it looks for leaks and races after that.
[[noreturn]] void end_program(int code);

}  // namespace boule::cli
