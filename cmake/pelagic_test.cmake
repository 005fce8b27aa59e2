# Registers tests. Each is one process with a limit of time and of memory, and has labels, by which
# the presets select tests.
#
#   a GoogleTest program of the sources NAME_test.cpp; each of its suites is a test:
#       pelagic_test_program(pelagic_query_tests TESTS cubic_query LIBRARIES pelagic::sim)
#   any other program:
#       pelagic_add_test(CInterfaceSoak LABELS slow COMMAND pelagic_soak 20000)
#
# TESTS        sources NAME_test.cpp
# SOURCES      other sources, and objects
# LIBRARIES    besides GoogleTest
# RUNS         a program that the tests run, as pelagic::tested_binary (test_paths.hpp)
# LABELS       bits (other compilers and processors), threads (ThreadSanitizer), c-interface,
#              numbers (not in asan), drawing (in asan at night), fuzz, fuzz-soak, slow (not in
#              `quick`), hosts (inside other programs, not in `quick`), web, night, soak
# SLOW         suites that `quick` omits (label slow)
# SWEEPS       suites that test a sample by default (label slow) and the full range as Soak.SUITE
# SERIAL       suites during which no other test runs
# TIMEOUT_S    wall-clock seconds, far more than a loaded machine needs
# MEMORY_MIB   address space; resident memory under a sanitizer, which maps terabytes
#
# The target tests-LABEL builds the programs with a label, tests-memory those that asan runs.
set(PELAGIC_TEST_TIMEOUT_S 600)
set(PELAGIC_NIGHT_TIMEOUT_S 7200)
set(PELAGIC_TEST_MEMORY_MIB 4096)
if(CMAKE_HOST_SYSTEM_NAME STREQUAL Linux)
  find_program(PELAGIC_PRLIMIT prlimit REQUIRED)
endif()

# Sets a command prefix and environment variables that limit a command's memory to `mib`.
function(pelagic_memory_limit mib launcher environment)
  set(${launcher} PARENT_SCOPE)
  set(${environment} PARENT_SCOPE)
  if(PELAGIC_SANITIZE MATCHES thread)
    set(${launcher} ${PROJECT_SOURCE_DIR}/tests/limit_resident.sh ${mib} PARENT_SCOPE)
  elseif(EMSCRIPTEN OR NOT PELAGIC_PRLIMIT)
    # node reserves more addresses than it uses, and a module's memory ends at 4 GiB; other systems
    # have no such limit
    return()
  elseif(PELAGIC_SANITIZE)
    # Up to LLVM 16 the interceptor of __tls_get_addr takes some blocks of thread-local storage for
    # those of a glibc before 2.25, and the leak check then crashes at exit
    # (https://github.com/google/sanitizers/issues/1322).
    set(${environment} ASAN_OPTIONS=path_list_append:hard_rss_limit_mb=${mib}:intercept_tls_get_addr=0 PARENT_SCOPE)
  else()
    math(EXPR bytes "${mib} * 1024 * 1024")
    set(${launcher} ${PELAGIC_PRLIMIT} --as=${bytes} -- PARENT_SCOPE)
  endif()
endfunction()

function(pelagic_label target)
  if(NOT "${ARGN}" MATCHES "(^|;)(numbers|drawing|fuzz|fuzz-soak|hosts|web|night|soak)(;|$)")
    list(APPEND ARGN memory)
  endif()
  foreach(label IN LISTS ARGN)
    if(NOT TARGET tests-${label})
      add_custom_target(tests-${label})
    endif()
    add_dependencies(tests-${label} ${target})
  endforeach()
endfunction()

macro(pelagic_test_arguments)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "TIMEOUT_S;MEMORY_MIB;RUNS"
                        "LABELS;SLOW;SWEEPS;SERIAL;PROPERTIES;COMMAND;TESTS;SOURCES;LIBRARIES")
  if(NOT test_TIMEOUT_S)
    set(test_TIMEOUT_S ${PELAGIC_TEST_TIMEOUT_S})
  endif()
  if(NOT test_MEMORY_MIB)
    set(test_MEMORY_MIB ${PELAGIC_TEST_MEMORY_MIB})
  endif()
  if(test_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${ARGV0}: what is ${test_UNPARSED_ARGUMENTS}?")
  endif()
  pelagic_memory_limit(${test_MEMORY_MIB} launcher environment)
endmacro()

function(pelagic_add_test name)
  pelagic_test_arguments()
  list(POP_FRONT test_COMMAND program)
  set(emulator)
  if(TARGET ${program})
    pelagic_label(${program} ${test_LABELS})
    set(emulator ${CMAKE_CROSSCOMPILING_EMULATOR})
    set(program $<TARGET_FILE:${program}>)
  endif()
  add_test(NAME ${name} COMMAND ${launcher} ${emulator} ${program} ${test_COMMAND})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${test_TIMEOUT_S} LABELS "${test_LABELS}"
                       ENVIRONMENT_MODIFICATION "${environment}" ${test_PROPERTIES})
endfunction()

# The program lists its suites after each build.
function(pelagic_test_program target)
  pelagic_test_arguments()
  list(TRANSFORM test_TESTS APPEND _test.cpp)
  set(tested)
  if(test_RUNS)
    set(tested $<TARGET_FILE:${test_RUNS}>)
  endif()
  # A source of its own, because a compiler cache cannot share what contains a folder's path.
  set(paths ${CMAKE_CURRENT_BINARY_DIR}/${target}_paths.cpp)
  file(GENERATE OUTPUT ${paths} CONTENT "#include \"pelagic/tests/test_paths.hpp\"
namespace pelagic {
const char* const source_folder = \"${PROJECT_SOURCE_DIR}\";
const char* const tested_binary = \"${tested}\";
}  // namespace pelagic\n")
  set_source_files_properties(${paths} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(${target} ${test_TESTS} ${test_SOURCES} ${paths})
  pelagic_target(${target})
  target_include_directories(${target} SYSTEM PRIVATE ${PELAGIC_IMATH_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE ${test_LIBRARIES} GTest::gtest_main)
  if(test_RUNS)
    add_dependencies(${target} ${test_RUNS})
  endif()
  pelagic_label(${target} ${test_LABELS})
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  set(not_built ${CMAKE_CURRENT_BINARY_DIR}/${target}_not_built.cmake)
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D "PROGRAM=$<TARGET_FILE:${target}>" -D "EMULATOR=${CMAKE_CROSSCOMPILING_EMULATOR}"
            -D "LAUNCHER=${launcher}" -D "ENVIRONMENT=${environment}" -D "LABELS=${test_LABELS}" -D "SLOW=${test_SLOW}"
            -D "SWEEPS=${test_SWEEPS}" -D "SERIAL=${test_SERIAL}" -D "TIMEOUT_S=${test_TIMEOUT_S}"
            -D "NIGHT_TIMEOUT_S=${PELAGIC_NIGHT_TIMEOUT_S}" -D "PROPERTIES=${test_PROPERTIES}" -D "SUITES=${suites}"
            -P ${PROJECT_SOURCE_DIR}/cmake/gtest_suites.cmake
    BYPRODUCTS ${suites} VERBATIM)
  # If a preset does not build a program, a test of that preset fails.
  file(WRITE ${not_built} "if(EXISTS \"${suites}\")\n  include(\"${suites}\")\nelse()\n"
    "  add_test(${target}_was_not_built ${target}_was_not_built)\n"
    "  set_tests_properties(${target}_was_not_built PROPERTIES TIMEOUT 1 LABELS \"${test_LABELS}\")\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${not_built})
endfunction()
