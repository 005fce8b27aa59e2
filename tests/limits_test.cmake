# Checks that every test has a limit of time and of memory: tests that were added without
# pelagic_test.cmake are named.
#
# usage: cmake -D CTEST=... -D BUILD=... -P limits_test.cmake
execute_process(COMMAND ${CTEST} --test-dir ${BUILD} --show-only=json-v1 OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(JSON count LENGTH "${listed}" tests)
if(count LESS 2)
  message(FATAL_ERROR "ctest lists ${count} tests")
endif()
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON test GET "${listed}" tests ${i})
  string(JSON name GET "${test}" name)
  if(name MATCHES "_was_not_built$")
    continue()
  endif()
  if(NOT test MATCHES "\"TIMEOUT\"")
    message(SEND_ERROR "${name} has no TIMEOUT")
  endif()
  if(NOT test MATCHES "--as=[0-9]+|hard_rss_limit_mb=[0-9]+|limit_resident.sh")
    message(SEND_ERROR "${name} has no limit of memory")
  endif()
endforeach()
