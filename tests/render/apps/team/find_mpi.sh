#!/bin/bash
# find_mpi.sh SOURCE CXX: which MPIs a build finds. A compiler wrapper that tells of headers which are
# not there switches nothing on; an MPI anywhere is found, and its library by whoever loads the module.
set -euo pipefail
source=$1 cxx=$2
if compgen -G '/opt/*/bin/mpicc*' || compgen -G '/opt/*/*/bin/mpicc*' || compgen -G '/usr/local/*/bin/mpicc*' ||
  compgen -G '/usr/lib64/*/bin/mpicc*'; then
  echo "this machine has an MPI that is found whatever PATH is"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "find_mpi.sh: $*" >&2; exit 1; }

# What a build does with render/apps/team, alone.
mkdir "$folder/project"
cat > "$folder/project/CMakeLists.txt" << EOF
cmake_minimum_required(VERSION 3.25)
project(alone LANGUAGES CXX)
include($source/render/boule_compiles.cmake)
add_library(boule_flags INTERFACE)
target_include_directories(boule_flags INTERFACE $source)
target_compile_features(boule_flags INTERFACE cxx_std_20)
add_library(boule_hardened INTERFACE)
file(WRITE \${CMAKE_BINARY_DIR}/empty.cpp "")
add_library(boule_job STATIC \${CMAKE_BINARY_DIR}/empty.cpp)
add_library(fmt::fmt INTERFACE IMPORTED)
set(BOULE_INSTALL ON)
include(GNUInstallDirs)
add_subdirectory($source/render/apps/team team)
set_target_properties(boule_team PROPERTIES SOURCES \${CMAKE_BINARY_DIR}/empty.cpp)  # the modules alone
get_property(mpis GLOBAL PROPERTY BOULE_MPIS)
message(STATUS "found: \${mpis}.")
include($source/render/boule_library.cmake)
boule_library(boule_job away away.h away \${CMAKE_BINARY_DIR}/empty.cpp BOULE_HAS_AWAY "it is not there")
get_property(libraries GLOBAL PROPERTY BOULE_PC_LIBRARIES)
message(STATUS "libraries: \${libraries}.")
EOF

# A wrapper as those of Open MPI and MPICH: wrapper FILE WORDS...
wrapper() {
  mkdir -p "$(dirname "$1")"
  printf '#!/bin/sh\necho "gcc %s"\n' "${*:2}" > "$1"
  chmod +x "$1"
}
# build NAME: configures in a folder of its own with the PATH and variables of the caller.
build() { cmake -S "$folder/project" -B "$folder/$1" -DCMAKE_CXX_COMPILER="$cxx" "${@:2}"; }

# An MPI in a place of its own: fake NAME MACRO makes headers and a library that say who they are.
fake() {
  mkdir -p "$folder/$1/include" "$folder/$1/lib"
  cat > "$folder/$1/include/mpi.h" << EOF
#define $2 1
typedef int MPI_Comm, MPI_Request, MPI_Datatype, MPI_Errhandler;
typedef struct { int MPI_SOURCE; } MPI_Status;
enum { MPI_SUCCESS, MPI_COMM_WORLD, MPI_BYTE, MPI_REQUEST_NULL, MPI_ANY_SOURCE, MPI_THREAD_FUNNELED, MPI_ERRORS_RETURN };
#define MPI_STATUS_IGNORE ((MPI_Status*)0)
extern "C" {
int MPI_Finalize();
int MPI_Abort(MPI_Comm, int);
int MPI_Comm_rank(MPI_Comm, int*);
int MPI_Comm_size(MPI_Comm, int*);
int MPI_Comm_set_errhandler(MPI_Comm, MPI_Errhandler);
int MPI_Get_count(const MPI_Status*, MPI_Datatype, int*);
int MPI_Init_thread(int*, char***, int, int*);
int MPI_Iprobe(int, int, MPI_Comm, int*, MPI_Status*);
int MPI_Isend(const void*, int, MPI_Datatype, int, int, MPI_Comm, MPI_Request*);
int MPI_Recv(void*, int, MPI_Datatype, int, int, MPI_Comm, MPI_Status*);
int MPI_Test(MPI_Request*, int*, MPI_Status*);
}
EOF
  sed -n 's/^int \(MPI_[A-Za-z_]*\)(.*/extern "C" int \1() { return 0; }/p' "$folder/$1/include/mpi.h" \
    > "$folder/$1/mpi.cpp"
  "$cxx" -shared -fPIC -Wl,-soname,libmpi.so.7 "$folder/$1/mpi.cpp" -o "$folder/$1/lib/libmpi.so.7"
  ln -s libmpi.so.7 "$folder/$1/lib/libmpi.so"
  wrapper "$folder/$1/bin/mpicc" "-I$folder/$1/include -L$folder/$1/lib -lmpi"
}
fake first OPEN_MPI
fake second MPICH_NAME

# No MPI of the system is in PATH: tools are reached by links.
wrapper "$folder/bare/mpicc.openmpi" "-I/usr/lib/openmpi/include-not-there -L/usr/lib -lmpi"
wrapper "$folder/bare/mpicc.mpich" "-I/usr/include/mpich-not-there -L/usr/lib -lmpich"
wrapper "$folder/bare/mpicc" "nothing"
links=$folder/links
mkdir "$links"
for tool in "$cxx" cmake make ninja as ar ranlib ld uname sh; do
  path=$(command -v "$tool") && ln -sf "$path" "$links/$(basename "$tool")"
done

found=$(PATH=$folder/bare:$links build none)
grep -q 'found: \.' <<< "$found" || fail "headers that are not there switched on an MPI: $found"
grep -q 'Without openmpi and its headers' <<< "$found" || fail "not told: $found"
PATH=$folder/bare:$links cmake --build "$folder/none" > /dev/null || fail "it does not build"

# By PATH, by MPI_HOME as a variable of the environment or of CMake.
found=$(PATH=$folder/bare:$folder/first/bin:$links build path)
grep -q 'found: openmpi\.' <<< "$found" || fail "not found by PATH: $found"
found=$(PATH=$folder/bare:$folder/first/bin:$links MPI_HOME=$folder/second build home)
grep -q 'found: openmpi;mpich\.' <<< "$found" || fail "not found by MPI_HOME: $found"
found=$(PATH=$links build named -DMPI_HOME="$folder/second")
grep -q 'found: mpich\.' <<< "$found" || fail "not found by -DMPI_HOME: $found"

# What is loaded finds the library, built and installed.
unset LD_LIBRARY_PATH
cmake --build "$folder/path" > "$folder/log" 2>&1 || fail "it does not build: $(cat "$folder/log")"
cmake --install "$folder/path" --prefix "$folder/installed" > /dev/null
for module in "$folder/path/bin" "$folder"/installed/lib*/boule "$folder"/installed/lib/*/boule; do
  [ -d "$module" ] || continue
  needed=$(ldd "$module/boule_mpi_openmpi.so")
  grep -q "libmpi.so.7 => $folder/first/lib/libmpi.so.7" <<< "$needed" || fail "$module: $needed"
  modules=$((${modules:-0} + 1))
done
[ "${modules:-0}" = 2 ] || fail "$modules modules"

# The same for libraries: what is there and does not compile, or link, is not used.
mkdir -p "$folder"/away/{include,lib}
away() { cmake -S "$folder/project" -B "$folder/$1" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$folder/away"; }
echo 'extern "C" int away();' > "$folder/away/include/away.h"
grep -q 'Without away.h: it is not there' <<< "$(away library)" || fail "a header alone switched on a library"
echo 'extern "C" int near() { return 0; }' > "$folder/near.cpp"
"$cxx" -shared -fPIC "$folder/near.cpp" -o "$folder/away/lib/libaway.so"
grep -q 'Without away.h: it is not there' <<< "$(away library)" || fail "a library without its function is used"
sed -i s/near/away/ "$folder/near.cpp"
"$cxx" -shared -fPIC "$folder/near.cpp" -o "$folder/away/lib/libaway.so"
grep -q 'libraries: away\.' <<< "$(away library)" || fail "a library elsewhere is not found"

# An MPI that comes later is found by the same build folder; one that goes is not kept.
found=$(PATH=$folder/bare:$folder/second/bin:$links build none)
grep -q 'found: mpich\.' <<< "$found" || fail "a new one is not found: $found"
echo "find_mpi.sh: good"
