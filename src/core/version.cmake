# Writes OUT, the definition of tool_version(), where it would change: RELEASE and the commit of
# ROOT, from git, or from an archive that `git archive` made (commit.txt).
set(commit "")
file(STRINGS ${ROOT}/src/core/commit.txt archived LIMIT_COUNT 1)
if(archived MATCHES "^[0-9a-f]+$")
  set(commit "+g${archived}")
else()
  execute_process(COMMAND git rev-parse --show-toplevel WORKING_DIRECTORY ${ROOT}
                  OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${ROOT}" root)
  if(top STREQUAL root) # and not a repository that merely holds these sources
    execute_process(COMMAND git describe --always --exclude=* --abbrev=10 --dirty=.dirty
                    WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE described
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(described)
      set(commit "+g${described}")
    endif()
  endif()
endif()
set(text "// Made by src/core/version.cmake.
#include \"core/version.h\"

const char* frictab::tool_version() {
  return \"${RELEASE}${commit}\";
}
")
set(before "")
if(EXISTS ${OUT})
  file(READ ${OUT} before)
endif()
if(NOT text STREQUAL before)
  file(WRITE ${OUT} "${text}")
endif()
