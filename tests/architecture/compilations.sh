# shellcheck shell=bash
# Shared by the checks that read a database of compile commands. Source it.

# compilations COMPILE_COMMANDS ROOT: a line for each compilation of a source below ROOT, the source and
# the command with a tab between them. Of sources that are compiled together, by a file of CMake's that
# includes them, each has that file's command.
compilations() {
  awk -v root="$2/" '
    function tell(source) { if (index(source, root) == 1) print source "\t" command }
    /"command":/ { command = $0 }
    /"file":/ {
      file = $0
      sub(/^[^:]*: *"/, "", file)
      sub(/",? *$/, "", file)
      if (file !~ /\/Unity\/unity_[0-9]+_cxx\.cxx$/) tell(file)
      else while ((getline line < file) > 0) {
        if (line ~ /^#include "/) tell(substr(line, 11, length(line) - 11))
      }
      close(file)
      command = ""
    }' "$1"
}
