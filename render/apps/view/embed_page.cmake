# cmake -DOUTPUT=FILE.cpp -DFILES=A;B -P embed_page.cmake: a source that holds these files' bytes.
set(types ".html" "text/html; charset=utf-8" ".css" "text/css; charset=utf-8"
  ".js" "text/javascript; charset=utf-8" ".svg" "image/svg+xml")
set(arrays "")
set(rows "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  get_filename_component(extension "${file}" LAST_EXT)
  list(FIND types "${extension}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${file}: no type is known for it")
  endif()
  math(EXPR at "${at} + 1")
  list(GET types ${at} type)
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "char(0x\\1)," bytes "${bytes}")
  string(REGEX REPLACE "((char\\(0x[0-9a-f][0-9a-f]\\),){16})" "\\1\n" bytes "${bytes}")
  string(APPEND arrays "constexpr char file${number}[] = {\n${bytes}char(0)};\n")
  string(APPEND rows "  {\"${name}\", \"${type}\", {file${number}, sizeof file${number} - 1}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}" "#include \"render/apps/view/server/page_files.h\"

namespace boule::view {
namespace {

${arrays}
constexpr PageFile all[] = {
${rows}};

}  // namespace

std::span<const PageFile> page_files() { return all; }

}  // namespace boule::view
")
