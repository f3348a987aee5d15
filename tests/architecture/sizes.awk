# Files of at most 400 lines, functions of at most 50: what a reader can hold in mind. Reads source
# files by their path from the root, templates and what is not compiled here too; prints
# "PATH:LINE: what is wrong". A function's lines are counted as clang-tidy does: from the brace that
# opens its body to the one that closes it.

BEGIN {
  file_limit = 400
  function_limit = 50
}

function complain(line, text) {
  print file ":" line ": " text
  wrong = 1
}

# The line without comments, strings and characters; a comment or raw string may go on from the last
# line. Two quotes stay for a string, so that an operator or an argument is still seen to be there.
function code_of(line,    code, at, rest, delimiter) {
  code = ""
  while (line != "") {
    if (inside != "") {  # what ends the comment or raw string
      at = index(line, inside)
      if (!at) return code
      line = substr(line, at + length(inside))
      inside = ""
    } else if (!match(line, /\/\/|\/\*|R"[^(]*\(|"|'/)) {
      return code line
    } else {
      code = code substr(line, 1, RSTART - 1)
      rest = substr(line, RSTART + RLENGTH)
      delimiter = substr(line, RSTART, RLENGTH)
      line = rest
      if (delimiter == "//") return code
      if (delimiter == "/*") {
        inside = "*/"
      } else if (delimiter ~ /^R/) {
        inside = ")" substr(delimiter, 3, RLENGTH - 3) "\""
        code = code "\"\""
      } else if (delimiter == "'" && code ~ /[0-9a-fA-F]$/) {
        code = code ""  # 1'000'000
      } else {
        while (match(line, /^[^\\"']*(\\.|["'])/)) {
          rest = substr(line, RSTART + RLENGTH - 1, 1)
          at = substr(line, RLENGTH - 1, 1) == "\\"
          line = substr(line, RLENGTH + 1)
          if (!at && rest == delimiter) break
        }
        code = code delimiter delimiter
      }
    }
  }
  return code
}

# What a brace opens, from what stands before it since the last statement.
function kind_of(head) {
  if (functions) return "block"
  if (head ~ /^[ \t]*((inline[ \t]+)?namespace|extern[ \t]+"")/) return "scope"
  while (sub(/^[ \t]*template[ \t]*<[^<>]*(<[^<>]*>[^<>]*)*>/, "", head)) continue
  if (head ~ /^[ \t]*(typedef[ \t]+)?(class|struct|union|enum)[ \t]/ && head !~ /\)[ \t]*$/) return "scope"
  if (head ~ /\)[ \t]*((const|noexcept|override|final|mutable|&&?|->.*|:[^:].*)[ \t]*)*$/) return "function"
  return "list"
}

function read_braces(code,    character) {
  while (match(code, /[{};]/)) {
    head = head substr(code, 1, RSTART - 1)
    character = substr(code, RSTART, 1)
    code = substr(code, RSTART + 1)
    if (character == "{") {
      kind[++depth] = kind_of(head)
      heads[depth] = head
      opened[depth] = FNR
      if (kind[depth] == "function") ++functions
      head = ""
    } else if (character == "}" && depth) {
      if (kind[depth] == "function") {
        --functions
        # Members initialised by braces: the body is still to come.
        if (code ~ /^[ \t]*(,|\{)/ && heads[depth] ~ /\)[ \t]*:[^:]/) {
          head = heads[depth--] "0"
          continue
        }
        if (FNR - opened[depth] > function_limit)
          complain(opened[depth], "a function of " FNR - opened[depth] " lines, more than " function_limit)
      }
      head = kind[depth] == "list" ? heads[depth] "0" : ""
      --depth
    } else {
      head = ""
    }
  }
  head = head code " "
}

FNR == 1 {
  finish()
  file = FILENAME
  inside = head = ""
  continued = depth = functions = 0
}

{
  lines = FNR
  directive = continued || $0 ~ /^[ \t]*#/
  continued = directive && $0 ~ /\\$/
  if (!directive) read_braces(code_of($0))
}

function finish() {
  if (file == "") return
  if (lines > file_limit) complain(lines, "longer than " file_limit " lines")
  if (depth) complain(lines, "braces that are not understood")
}

END {
  finish()
  exit wrong
}
