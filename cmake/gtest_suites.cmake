# Runs after a GoogleTest program was built (pelagic_test.cmake) and writes one ctest test for each
# of its suites. There is one process for each suite, not for each test, because hundreds of
# processes take longer to start than to run, above all under a sanitizer.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${EMULATOR} ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE result TIMEOUT 120)
if(NOT result EQUAL 0)
  file(REMOVE ${PROGRAM})  # so that the next build lists them again
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests: ${result}\n${listed}")
endif()

# "Kinds/EachExecutor.  # GetParam() = ..." and "Seas/EachExecutor." both belong to the suite
# EachExecutor.
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." names "${listed}")
list(TRANSFORM names REPLACE "^\n" "")
list(TRANSFORM names REPLACE "\\.$" "")
list(TRANSFORM names REPLACE "/[0-9]+$" "")
list(TRANSFORM names REPLACE "^.*/" "")
list(REMOVE_DUPLICATES names)

set(script)
function(add_suite test suite timeout environment labels)
  set(filter "${suite}.*:*/${suite}.*:${suite}/*:*/${suite}/*")
  set(command)
  foreach(word IN ITEMS ${LAUNCHER} ${EMULATOR} ${PROGRAM} --gtest_filter=${filter})
    string(APPEND command " [==[${word}]==]")
  endforeach()
  list(JOIN PROPERTIES " " properties)
  # Without times of an earlier run, long tests start first: a long test at the end would use only
  # one core.
  if("slow" IN_LIST labels)
    string(PREPEND properties "COST 100 ")
  endif()
  if(suite IN_LIST SERIAL)
    string(PREPEND properties "RUN_SERIAL ON ")
  endif()
  string(APPEND script "add_test([==[${test}]==]${command})\n"
    "set_tests_properties([==[${test}]==] PROPERTIES TIMEOUT ${timeout} LABELS [==[${labels}]==]"
    " ENVIRONMENT_MODIFICATION [==[${environment}]==] ${properties})\n")
  set(script "${script}" PARENT_SCOPE)
endfunction()

foreach(suite IN LISTS names)
  if(suite IN_LIST SWEEPS)
    list(REMOVE_ITEM SWEEPS ${suite})
    add_suite(${suite} ${suite} ${TIMEOUT_S} "${ENVIRONMENT}" "${LABELS};slow")
    add_suite(Soak.${suite} ${suite} ${NIGHT_TIMEOUT_S} "${ENVIRONMENT};PELAGIC_FULL_SWEEPS=set:1" "soak")
  elseif(suite IN_LIST SLOW)
    list(REMOVE_ITEM SLOW ${suite})
    add_suite(${suite} ${suite} ${TIMEOUT_S} "${ENVIRONMENT}" "${LABELS};slow")
  else()
    add_suite(${suite} ${suite} ${TIMEOUT_S} "${ENVIRONMENT}" "${LABELS}")
  endif()
endforeach()
list(REMOVE_ITEM SERIAL ${names})
if(SWEEPS OR SLOW OR SERIAL)
  file(REMOVE ${PROGRAM})
  message(FATAL_ERROR "${PROGRAM} has no suite ${SWEEPS} ${SLOW} ${SERIAL}")
endif()
file(WRITE ${SUITES} "${script}")
