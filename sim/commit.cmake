# Writes HEADER with the commit of SOURCE and its date, "unknown" and "" where there is no git; untouched if it says so
# already.
cmake_minimum_required(VERSION 3.25)
set(commit "unknown")
set(date "")
find_program(GIT git)
function(ask_git answer otherwise)
  # In a container the tree often belongs to someone else, which git would refuse.
  execute_process(COMMAND ${GIT} -c safe.directory=${SOURCE} ${ARGN} WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE said ERROR_QUIET RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(failed)
    set(said "${otherwise}")
  endif()
  set(${answer} "${said}" PARENT_SCOPE)
endfunction()
if(GIT AND EXISTS ${SOURCE}/.git)
  ask_git(commit "unknown" describe --always --dirty --abbrev=12)
  ask_git(date "" log -1 --format=%cs)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define COSYS_COMMIT \"@commit@\"\n#define COSYS_COMMIT_DATE \"@date@\"\n" @ONLY)
