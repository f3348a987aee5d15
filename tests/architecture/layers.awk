# Who may include what, and who owns what: the layers and owners of docs/architecture.md.
# Reads source files by their path from the root; prints "PATH:LINE: what is wrong".

BEGIN {
  any = ""
  word = "[^_a-zA-Z0-9.>]"  # what may stand before a name
  plain_std = "^<[a-z_0-9]+>$"
  # The standard headers without containers, strings, streams and calls into other objects.
  kernel_std = "^<(array|bit|cmath|concepts|cstddef|cstdint|cstring|limits|type_traits|utility)>$"
  # Formulas, each a template that scalar code and kernels share: always inlined, and headers only,
  # or a kernel would call code that was compiled for another instruction set.
  formulas = "^core/(base/platform|math/(elementary|geometry|interval|light_cone|number|random|ray|sobol|vec|warp)|optics/(camera_view|cameras|dielectric|film_point|incidence|lens_disc|lens_rays|lens_view|lobes|reflectance))\\.h$"
  narrow = "^(core|simd/(abi|geometry|stream|dispatch))/"

  layer(formulas, formulas, kernel_std)
  layer("^core/base/memory_pages\\.cpp$", "^core/", plain_std "|^<(sys/mman|unistd)\\.h>$")
  layer("^core/", "^core/", plain_std)
  layer("^simd/abi/", "^(simd/abi/|core/(base/platform|math/(ray|vec)|optics/(camera|lens)_view)\\.h$)", kernel_std)
  layer("^simd/(geometry|stream)/", "^(core|simd/(abi|geometry|stream))/", plain_std)
  layer("^simd/lanes/", formulas "|^simd/(abi|lanes)/", kernel_std "|^<xsimd/")
  layer("^simd/kernel/", formulas "|^simd/(abi|lanes|kernel)/", kernel_std)
  layer("^simd/dispatch/", "^(core|simd/(abi|dispatch))/", plain_std "|^<cpuid\\.h>$")
  layer("^render/include/", "^(core|simd/(abi|geometry|stream|dispatch)|render/(frame|image|renderer|scene_file))/", any)
  layer("^render/memory/", "^(core|render/memory)/", any)
  layer("^render/file/", "^(core|render/(memory|file))/", any)
  layer("^render/particle_file/", "^(core|render/(memory|file|particle_file))/", any)
  layer("^render/particles/", "^(core|render/(memory|file|particle_file|particles))/", any)
  layer("^render/packed/", narrow "|^render/(memory|file|packed)/|^render/image/output_file\\.h$", any)
  # Scenes name pictures: their reader returns plain numbers, which core can hold.
  layer("^render/scene_file/", "^(core|render/(memory|file|particle_file|particles|packed|scene_file))/|^render/image/(read_)?image\\.h$", any)
  layer("^render/threads/", "^render/threads/", plain_std "|^<pthread\\.h>$")
  layer("^render/image/", "^(core|render/(memory|threads|image))/", any)
  layer("^render/frame/", "^(core|render/(memory|threads|image|frame))/", any)
  layer("^render/trace_file/", "^(core|render/(file|image|frame|trace_file))/", any)
  layer("^render/prepare/", narrow "|^render/prepare/", any)
  layer("^render/shading/", narrow "|^render/(prepare|shading)/", any)
  layer("^render/integrators/", narrow "|^render/(prepare|shading|integrators)/", any)
  layer("^render/renderer/",
        narrow "|^render/(memory|image|frame|prepare|shading|integrators|renderer)/", any)
  layer("^render/view/",
        narrow "|^render/(memory|threads|particles|scene_file|image|frame|prepare|shading|integrators|renderer|view)/", any)
  layer("^render/cli/", narrow "|^render/(memory|threads|file|particle_file|particles|packed|scene_file|image|frame|trace_file|prepare|shading|integrators|renderer|view|parts|team|cli)/", any)
  # Of the program, what says how files are shown and written; nothing that owns the terminal or the
  # process.
  layer("^render/manual/", "^(core|simd/(abi|dispatch)|render/(image|particle_file|cli|manual))/", any)
  layer("^render/python/", narrow "|^render/(memory|threads|file|particle_file|particles|scene_file|image|frame|prepare|renderer|parts|python)/|^render/cli/(legend|look_values|option_values|options|particle_scene|picture_header|scene_loader|source_date)\\.h$", any)
  layer("^render/parts/",
        narrow "|^render/(memory|file|image|frame|prepare|integrators|renderer|parts)/", any)
  layer("^render/team/", "^(core|render/(threads|image|frame|renderer|parts|team))/", any)
  # These tests run on machines without the renderer's packages.
  layer("^tests/core/", "^(core|tests/(core|support))/", any)
  layer("^tests/simd/lanes/", narrow "|^simd/lanes/|^tests/(simd|support)/", any)
  layer("^tests/simd/", narrow "|^tests/(simd|support)/", any)
  layer("^tests/equivalence/", narrow "|^tests/(equivalence|support)/", any)
  layer("^tests/support/", narrow "|^tests/support/", any)
  # The command line is fuzzed and tested without its program, and so is what tells the time.
  layer("^tests/(fuzz/fuzz_options|render/cli/)", narrow "|^render/|^tests/", any)
  layer("^(tests|bench)/", narrow "|^render/(memory|threads|file|particle_file|particles|packed|scene_file|image|frame|trace_file|prepare|shading|integrators|renderer|view|parts|team)/|^tests/|^bench/", any)

  # Outside things and their one owner; tests and benchmarks are free to use them.
  owner("#include <xsimd/", "^simd/lanes/xsimd_", "xsimd")
  owner("#include <OpenImageIO/", "^render/image/(image_module\\.cpp|module_writer\\.(h|cpp)|descriptor_proxy\\.h)$", "OpenImageIO")
  owner("#include <png\\.h>", "^render/image/png_table\\.cpp$", "libpng")
  owner("#include <boost/", "^render/view/web_server\\.cpp$", "Boost")
  owner("#include <turbojpeg", "^render/view/jpeg\\.cpp$", "libjpeg-turbo")
  owner("#include <pybind11/|#include <Python\\.h>", "^render/python/", "Python")
  owner("#include <mpi\\.h>", "^render/team/mpi_module\\.cpp$", "MPI")
  owner("#include <(gemmi|tao)/", "^render/particle_file/gemmi_", "gemmi")
  owner("#include <(thread|future|execution|pthread\\.h|tbb/.*)>", "^render/threads/", "threads")
  owner("std::(jthread|thread|async)[^_a-z]|pthread_create", "^render/threads/", "threads")
  owner("#include <(cpuid\\.h|sys/auxv\\.h)>|__builtin_cpu_|xgetbv|getauxval", "^simd/dispatch/cpu\\.", "CPUID")
  owner("#include <(iostream|print|syslog\\.h)>|std::(cout|cerr|clog|cin)[^_a-z]|" word "(v?[fd]?printf|f?puts|f?putc|putchar|fmt::print|perror|syslog)[ (]|" word "(stdout|stderr|STD(OUT|ERR)_FILENO)[^_a-zA-Z0-9]", "^render/cli/", "the terminal")
  owner("#include <c?assert(\\.h)?>|" word "(_exit|_Exit|exit|quick_exit|abort|terminate|raise|longjmp|assert|__builtin_(trap|abort|unreachable))[ ]*\\(", "^render/(cli/|python/call\\.cpp$)", "the end of the process")
  owner(word "(secure_)?getenv[ ]*\\(", "^(render/cli|simd/dispatch)/", "the environment")
  anywhere("^[ \t]*#[ \t]*define[ \t]", "^core/base/platform\\.h$", "a macro")
}

function layer(path, project, outside) {
  layer_path[++layers] = path
  layer_project[layers] = project
  layer_std[layers] = outside
}
function owner(pattern, path, what) {
  owner_pattern[++owners] = pattern
  owner_path[owners] = path
  owner_what[owners] = what
}
function anywhere(pattern, path, what) {
  owner(pattern, path, what)
  owner_everywhere[owners] = 1
}

function complain(text) {
  print FILENAME ":" FNR ": " text
  wrong = 1
}

function check_include(line,    name, outside) {
  name = line
  sub(/^[ \t]*#[ \t]*include[ \t]*/, "", name)
  sub(/[ \t]*$/, "", name)
  if (!own) {
    complain("belongs to no layer")
  } else if (name ~ /^</) {
    outside = layer_std[own]
    if (outside != "" && name !~ outside) complain("may not include " name)
  } else {
    gsub(/"/, "", name)
    if (name !~ /^(core|simd|render|tests|bench)\// || name ~ /\.\.?\//) {
      complain("include \"" name "\" is not written from the root")
    } else if (name !~ layer_project[own]) {
      complain("may not include " name)
    }
  }
}

FNR == 1 {
  own = 0
  for (i = 1; i <= layers && !own; ++i) {
    if (FILENAME ~ layer_path[i]) own = i
  }
}

{
  code = $0
  if (code ~ /^[ \t]*#[ \t]*include/) {
    sub(/[ \t]*\/\/.*/, "", code)
    check_include(code)
  } else {
    # Comments and literals say what they like. A quote inside a character is not a string's.
    gsub(/'\\?.'/, "0", code)
    gsub(/\\./, "", code)
    gsub(/"[^"]*"/, "0", code)
    sub(/\/\/.*/, "", code)

  }
  for (i = 1; i <= owners; ++i) {
    if (!owner_everywhere[i] && FILENAME ~ /^(tests|bench)\//) continue
    if ((" " code " ") ~ owner_pattern[i] && FILENAME !~ owner_path[i]) {
      complain(owner_what[i] " has another owner")
    }
  }
}

END {
  exit wrong
}
