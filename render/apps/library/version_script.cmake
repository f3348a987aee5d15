# cmake -DHEADERS=FILE;... -DOUTPUT=FILE -P version_script.cmake: what the shared library shows. It is
# what the public headers declare outside of classes, and the members of their classes; all else is
# hidden. Declarations begin in the first column, as clang-format has them.

# encoded(NAME result): boule::Film as 5boule4Film, as symbols have it.
function(encoded name result)
  string(REPLACE "::" ";" parts "${name}")
  set(code)
  foreach(part IN LISTS parts)
    string(LENGTH "${part}" length)
    string(APPEND code ${length}${part})
  endforeach()
  set(${result} ${code} PARENT_SCOPE)
endfunction()

set(names)
set(members)
foreach(header IN LISTS HEADERS)
  file(READ ${header} text)
  string(REGEX REPLACE "[][;]" "@" text "${text}")  # lists of CMake cannot hold them
  string(REPLACE "\n" ";" lines "${text}")
  set(scope boule)
  foreach(line IN LISTS lines)
    if(line MATCHES "^namespace (boule[a-z_:]*) {")
      set(scope ${CMAKE_MATCH_1})
    elseif(line MATCHES "^namespace ([a-z_]+) {")
      set(scope boule::${CMAKE_MATCH_1})
    elseif(line MATCHES "^}  // namespace")
      set(scope boule)
    elseif(line MATCHES "^(inline|constexpr|template|using|BOULE_INLINE)")
      continue()  # in every program that uses it
    elseif(line MATCHES "^(class|struct) (.* )?([A-Za-z0-9_]+) (final )?(: .*)?{")
      encoded("${scope}::${CMAKE_MATCH_3}" class)
      list(APPEND members "_ZN${class}*" "_ZNK${class}*")  # those that are const have the K
    elseif(line MATCHES "^([A-Za-z@][^(]*[ &*])?([A-Za-z0-9_]+)\\(")
      list(APPEND names "${scope}::${CMAKE_MATCH_2}(")
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES names)
list(SORT names)
list(REMOVE_DUPLICATES members)
list(SORT members)
list(TRANSFORM members PREPEND "    ")
list(TRANSFORM members APPEND "\;\n")
string(JOIN "" members ${members})
set(shown)
foreach(name IN LISTS names)
  # Then comes the parameter list, or first [abi:cxx11]; the linker takes no parenthesis.
  string(REPLACE "(" "[!A-Za-z0-9_]*" pattern "${name}")
  string(APPEND shown "      ${pattern};\n")
endforeach()
file(WRITE ${OUTPUT} "{\n  global:\n    extern \"C++\" {\n${shown}    };\n${members}  local: *;\n};\n")
