# Writes HEADER with the commit of SOURCE, "unknown" where there is no git; untouched if it says so already.
cmake_minimum_required(VERSION 3.25)
set(commit "unknown")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  # In a container the tree often belongs to someone else, which git would refuse.
  execute_process(COMMAND ${GIT} -c safe.directory=${SOURCE} describe --always --dirty --abbrev=12
                  WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE said ERROR_QUIET RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    set(commit "${said}")
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define COSYS_COMMIT \"@commit@\"\n" @ONLY)
