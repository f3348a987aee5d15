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
  formulas = "^core/(base/platform|math/(elementary|error_free|geometry|interval|light_cone|number|random|ray|sobol|vec|warp)|optics/(camera_view|cameras|dielectric|film_point|incidence|lens_disc|lens_rays|lens_view|lobes|reflectance))\\.h$"
  narrow = "^(core|simd/(abi|geometry|points|stream|dispatch))/"

  layer(formulas, formulas, kernel_std)
  layer("^core/base/memory_pages\\.cpp$", "^core/", plain_std "|^<(sys/mman|unistd)\\.h>$")
  layer("^core/", "^core/", plain_std)
  layer("^simd/abi/", "^(simd/abi/|core/(base/platform|math/(color|ray|vec)|optics/(camera|lens)_view)\\.h$)", kernel_std)
  layer("^simd/(geometry|stream)/", "^(core|simd/(abi|geometry|stream))/", plain_std)
  layer("^simd/points/", "^(core|simd/(abi|geometry|points))/", plain_std)
  layer("^simd/lanes/", formulas "|^simd/(abi|lanes)/", kernel_std "|^<xsimd/")
  layer("^simd/kernel/", formulas "|^simd/(abi|lanes|kernel)/", kernel_std)
  layer("^simd/dispatch/", "^(core|simd/(abi|dispatch))/", plain_std "|^<cpuid\\.h>$")
  # The engine: it includes nothing of the wings.
  engine = "memory|threads|image|frame|prepare|shading|integrators|renderer"
  layer("^render/threads/", "^render/threads/", plain_std "|^<pthread\\.h>$")
  layer("^render/memory/", "^(core|render/memory)/", any)
  layer("^render/image/", "^(core|render/(memory|threads|image))/", any)
  layer("^render/frame/", "^(core|render/(memory|threads|image|frame))/", any)
  layer("^render/prepare/", narrow "|^render/prepare/", any)
  layer("^render/shading/", narrow "|^render/(prepare|shading)/", any)
  layer("^render/integrators/", narrow "|^render/(prepare|shading|integrators)/", any)
  layer("^render/renderer/",
        narrow "|^render/(memory|image|frame|prepare|shading|integrators|renderer)/", any)

  # The wing of files: nothing of apps, and of the engine what says how much memory there is, and pictures.
  layer("^render/files/file/", "^(core|render/(memory|files/file))/", any)
  layer("^render/files/particle_file/", "^(core|render/(memory|files/(file|particle_file)))/|^render/image/module/module_search\\.h$", any)
  layer("^render/files/particles/", "^(core|render/(memory|files/(file|particle_file|particles)))/", any)
  layer("^render/files/packed/", narrow "|^render/(memory|files/(file|packed))/|^render/image/output_file\\.h$", any)
  # Scenes name pictures: their reader returns plain numbers, which core can hold.
  layer("^render/files/scene_file/", "^(core|render/(memory|files/(file|particle_file|particles|packed|scene_file)))/|^render/image/(read_)?image\\.h$", any)
  layer("^render/files/trace_file/", "^(core|render/(image|frame|files/(file|trace_file)))/", any)

  # The wing of apps: what people start. None of them includes another.
  below = narrow "|^render/(" engine "|files/[a-z_]+)/"
  layer("^render/apps/library/", narrow "|^render/(frame|image|renderer|files/scene_file)/", any)
  layer("^render/apps/parts/", below "|^render/apps/parts/", any)
  layer("^render/apps/job/", below "|^render/apps/(parts|job)/", any)
  layer("^render/apps/team/", below "|^render/apps/(parts|team)/", any)
  layer("^render/apps/view/(messages|panes)/", below "|^render/apps/(job|view/(messages|panes))/", any)
  layer("^render/apps/view/session/", below "|^render/apps/(job|view/(messages|panes|session))/", any)
  layer("^render/apps/view/server/", below "|^render/apps/(job|view/(messages|session|server))/", any)
  layer("^render/apps/cli/", below "|^render/apps/(parts|job|team|view|cli)/", any)
  python = narrow "|^render/(memory|threads|image|frame|prepare|renderer|files/[a-z_]+|apps/(parts|job))/"
  layer("^render/apps/python/values/", python "|^render/apps/python/values/", any)
  layer("^render/apps/python/scenes/", python "|^render/apps/python/(values|scenes)/", any)
  layer("^render/apps/python/(pictures|queries)/", python "|^render/apps/python/", any)
  layer("^render/apps/python/", python "|^render/apps/python/", any)
  layer("^render/apps/manual/", below "|^render/apps/(job|cli|manual)/", any)

  # These tests run on machines without the renderer's packages.
  layer("^tests/core/", "^(core|tests/(core|support))/", any)
  layer("^tests/simd/lanes/", narrow "|^simd/lanes/|^tests/(simd|support)/", any)
  layer("^tests/simd/", narrow "|^tests/(simd|support)/", any)
  layer("^tests/equivalence/", narrow "|^tests/(equivalence|support)/", any)
  layer("^tests/support/", narrow "|^tests/support/", any)
  # The command line is fuzzed and tested without its program, and so is what tells the time.
  layer("^tests/(fuzz/fuzz_options|render/apps/(cli|job)/)", narrow "|^render/|^tests/", any)
  layer("^(tests|bench)/", below "|^render/apps/(parts|job|team|view)/|^tests/|^bench/", any)

  # Outside things and their one owner; tests and benchmarks are free to use them.
  owner("#include <xsimd/", "^simd/lanes/xsimd_", "xsimd")
  owner("#include <OpenImageIO/", "^render/image/module/(image_module\\.cpp|module_writer\\.(h|cpp)|descriptor_proxy\\.h)$", "OpenImageIO")
  owner("#include <png\\.h>", "^render/image/png_table\\.cpp$", "libpng")
  owner("#include <(pango|cairo)", "^render/apps/job/overlay/overlay_module\\.cpp$", "cairo and pango")
  owner("#include <hdf5", "^render/files/particle_file/hdf5/hdf5_values\\.h$", "libhdf5")
  owner("#include <boost/", "^render/apps/view/server/web_server\\.cpp$", "Boost")
  owner("#include <turbojpeg", "^render/apps/view/panes/jpeg\\.cpp$", "libjpeg-turbo")
  owner("#include <pybind11/|#include <Python\\.h>", "^render/apps/python/", "Python")
  owner("#include <mpi\\.h>", "^render/apps/team/mpi_module\\.cpp$", "MPI")
  owner("#include <(gemmi|tao)/", "^render/files/particle_file/molecule/gemmi_", "gemmi")
  owner("#include <(thread|future|execution|pthread\\.h|tbb/.*)>", "^render/threads/", "threads")
  owner("std::(jthread|thread|async)[^_a-z]|pthread_create", "^render/threads/", "threads")
  owner("#include <(cpuid\\.h|sys/auxv\\.h)>|__builtin_cpu_|xgetbv|getauxval", "^simd/dispatch/cpu\\.", "CPUID")
  owner("#include <(iostream|print|syslog\\.h)>|std::(cout|cerr|clog|cin)[^_a-z]|" word "(v?[fd]?printf|f?puts|f?putc|putchar|fmt::print|perror|syslog)[ (]|" word "(stdout|stderr|STD(OUT|ERR)_FILENO)[^_a-zA-Z0-9]", "^render/apps/cli/", "the terminal")
  owner("#include <c?assert(\\.h)?>|" word "(_exit|_Exit|exit|quick_exit|abort|terminate|raise|longjmp|assert|__builtin_(trap|abort|unreachable))[ ]*\\(", "^render/apps/(cli/|python/values/call\\.cpp$)", "the end of the process")
  owner(word "(secure_)?getenv[ ]*\\(", "^(render/apps/cli|simd/dispatch)/|^render/apps/job/picture/source_date\\.cpp$", "the environment")
  owner("#include <fast_float/", "^render/files/particle_file/text/text_number\\.cpp$", "fast_float")
  anywhere("^[ \t]*#[ \t]*define[ \t]", "^(core/base/platform\\.h|render/files/particle_file/text/text_number\\.cpp)$", "a macro")
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
