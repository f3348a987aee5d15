# Writes commit.cpp: the commit that is built, with "+" if files were changed since. The file is
# written only if its text changes, so that nothing is rebuilt in vain.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD
  OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT commit)
  set(commit "unknown")
endif()
execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
  OUTPUT_VARIABLE changes ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
if(changes)
  string(APPEND commit "+")
endif()
set(text "#include \"bench/report/commit.h\"\n\nnamespace boule::bench {\n\n\
std::string commit_of_build() { return \"${commit}\"; }\n\n}  // namespace boule::bench\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
