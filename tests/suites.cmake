# Writes OUTPUT, which CTest reads: an entry for each suite of a test program, so that a process is started once
# for a suite and not once for a case. Cases called Measured... have an entry of their own with the label
# `measured`: they hold figures against the model and take long, so the builds for sanitizers leave them out
# (-LE measured). Lists of names, "A|B", say what else a suite is; that of a parameterised suite is what follows its "/".
#   GATE: its measurements have the label `gate` too, and tests/run leaves them to the gate
#   WEEKLY: theirs is `weekly` instead
#   OUTSIDE, AGAIN: the suite has the label `outside` or `again`
#   PLAIN: of the others, those in the list have `plain`: in a gate the address sanitizer's build alone runs them
#   THREADS: it has the label `threads` where a part of its name, or of one of its cases, is in the list
#   LONG: it is begun before others
# Usage: cmake -D PROGRAM=... -D PREFIX=... -D THREADS=... -D LONG=... -D GATE=... -D WEEKLY=... -D OUTSIDE=...
#   -D AGAIN=... -D PLAIN=... -D OUTPUT=... -P suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[ \t]*#[^\n]*" "" listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")

set(entries "")
function(add_entry suite name filter labels)
  string(APPEND entries
         "add_test([=[${PREFIX}.${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter}]=] --gtest_brief=1)\n"
         "set_tests_properties([=[${PREFIX}.${name}]=] PROPERTIES LABELS [=[${labels}]=]")
  if(labels MATCHES "measured")
    string(APPEND entries " COST 100")  # begun first, so that nothing long is left for the end
  elseif(suite MATCHES "^(.*/)?(${LONG})$")
    string(APPEND entries " COST 50")
  endif()
  string(APPEND entries ")\n")
  set(entries "${entries}" PARENT_SCOPE)
endfunction()

function(add_suite suite cases)
  set(measured FALSE)
  set(plain FALSE)
  set(labels "")
  foreach(case ${cases})
    if(case MATCHES "^Measured")
      set(measured TRUE)
    else()
      set(plain TRUE)
    endif()
    if("${suite}.${case}" MATCHES "${THREADS}")
      set(labels "threads")
    endif()
  endforeach()
  if(suite MATCHES "^(.*/)?(${OUTSIDE})$")
    list(APPEND labels "outside")
  elseif(suite MATCHES "^(.*/)?(${AGAIN})$")
    list(APPEND labels "again")
  elseif(PREFIX STREQUAL "sim" AND suite MATCHES "^(.*/)?(${PLAIN})$")
    list(APPEND labels "plain")
  endif()
  if(plain)
    add_entry("${suite}" "${suite}" "${suite}.*-${suite}.Measured*" "${labels}")
  endif()
  if(measured)
    set(labels "measured")
    if(suite MATCHES "^(.*/)?(${WEEKLY})$")
      list(APPEND labels "weekly")
    elseif(suite MATCHES "^(.*/)?(${GATE})$")
      list(APPEND labels "gate")
    endif()
    add_entry("${suite}" "${suite}.measured" "${suite}.Measured*" "${labels}")
  endif()
  set(entries "${entries}" PARENT_SCOPE)
endfunction()

set(suite "")
set(cases "")
foreach(line ${lines})
  if(line MATCHES "^  (.+)$")
    list(APPEND cases "${CMAKE_MATCH_1}")
  elseif(line MATCHES "^([^ ].*)[.]$")
    set(next "${CMAKE_MATCH_1}")  # add_suite() matches too
    if(suite)
      add_suite("${suite}" "${cases}")
    endif()
    set(suite "${next}")
    set(cases "")
  endif()
endforeach()
add_suite("${suite}" "${cases}")
file(WRITE ${OUTPUT} "${entries}")
