# Writes the tests of PROGRAM for ctest, one for each suite, to OUT. A process for each of thousands
# of tests spends longer on starting than on testing, and what a suite prepares it prepares once.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[^ \n]+\\." suites "\n${listed}") # the tests of a suite are indented
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} lists no tests")
endif()
set(skipped [=[\[  PASSED  \] 0 tests\.
\[  SKIPPED \] [^
]* below:
(\[  SKIPPED \] [^
]*
)+$]=])
set(text "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n|\\.$" "" suite "${suite}")
  set(properties "TIMEOUT 900 SKIP_REGULAR_EXPRESSION [==[${skipped}]==]\n")
  string(APPEND properties "  ENVIRONMENT_MODIFICATION [==[PATH=path_list_prepend:${COMPILERS}]==]")
  if(suite MATCHES "^Long|/Long")
    string(APPEND properties " LABELS [==[slow;long]==] COST 200")
  elseif(suite MATCHES "^Slow|/Slow") # begun first: what is quick fills the gaps at the end
    string(APPEND properties " LABELS slow COST 100")
  endif()
  string(APPEND text "add_test([==[${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
         "set_tests_properties([==[${suite}]==] PROPERTIES ${properties})\n")
endforeach()
file(WRITE ${OUT} "${text}")
