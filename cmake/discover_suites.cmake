# Writes a file for ctest with one test a suite of GoogleTest: tests of a suite share what it renders, and a process.
# A suite of which every test is skipped is skipped.
# usage: cmake -D PROGRAM=<tests> -D LABEL=<label> -D OUT=<file> -P discover_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n]+\\.[^\n]*" suites "${listing}")
set(skipped [=[\\[  PASSED  \\] 0 tests\\.\n\\[  SKIPPED \\][^\n]*\n$]=])
set(text "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "^\n?([^ ]+)\\..*" "\\1" suite "${suite}")
  string(APPEND text "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=] --gtest_brief=1)\n"
                     "set_tests_properties([=[${suite}]=] PROPERTIES LABELS ${LABEL} TIMEOUT 3600\n"
                     "                     SKIP_REGULAR_EXPRESSION \"${skipped}\")\n")
endforeach()
file(WRITE ${OUT} "${text}")
