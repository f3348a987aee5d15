#pragma once

#include <string>

/// Files that other people's libraries read, in Python: a process runs bridge/boule_read.py, which
/// describes how it answers. It lives as long as the reader.
namespace boule {

/// Names the program that runs Python for such files: a path, or a name in PATH; "/usr/bin/python3"
/// by default. It counts for the whole process. Call it before files are opened: no other thread
/// may open one meanwhile.
void set_bridge_python(std::string program);

}  // namespace boule
