# shellcheck shell=bash
# Shared by find_package.sh and add_subdirectory.sh, which build an outside project. Source it.
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
cmake="$1" generator="$2" cxx="$3" flags="${4#flags=}"
shift 4
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# build FOLDER OPTION...: configures and builds tests/consumer/FOLDER in $work/build.
build() {
  local folder="$1"
  shift
  if ! {
    env -u CXXFLAGS "$cmake" -S "$here/$folder" -B "$work/build" -G "$generator" "$@" \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_CXX_FLAGS="$flags" \
      -DCMAKE_EXPORT_COMPILE_COMMANDS=ON &&
      "$cmake" --build "$work/build" -j2
  } >"$work/log" 2>&1; then
    cat "$work/log"
    exit 1
  fi
}

# inherits SOURCE INCLUDE: the outside source is compiled with its own flags, C++20 and the include
# path, and nothing else.
inherits() {
  local expected="$cxx -O3 -DNDEBUG -std=gnu++20 $2" found
  [[ -z "$flags" ]] || expected="$cxx $flags -O3 -DNDEBUG -std=gnu++20 $2"
  found="$(sed -n 's/^ *"command": "\(.*\)",$/\1/p' "$work/build/compile_commands.json" |
    grep -F -e "/$1 " -e "/$1" | sed 's/ -o .*//')"
  # CMake may choose the order.
  if [[ "$(tr ' ' '\n' <<<"$found" | sort)" != "$(tr ' ' '\n' <<<"$expected" | sort)" ]]; then
    printf '%s is compiled with\n  %s\nexpected\n  %s\n' "$1" "$found" "$expected"
    exit 1
  fi
}

# prints EXPECTED COMMAND...: its standard output, to the letter.
prints() {
  local expected="$1" found
  shift
  found="$("$@")"
  [[ "$found" == "$expected" ]] || { printf 'said\n%s\nexpected\n%s\n' "$found" "$expected"; exit 1; }
}
