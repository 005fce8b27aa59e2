# Embeds the project's stored benchmark results as text in the command, so that an installed command
# needs no files. They are read when the build is configured, again whenever a file changes.
#
#   pelagic_write_stored_results(RESULTS bench/results INSTRUCTIONS bench/budgets.json
#                                BYTES bench/bytes.json OUTPUT stored_results.inc)
function(pelagic_write_stored_results)
  cmake_parse_arguments(PARSE_ARGV 0 stored "" "RESULTS;INSTRUCTIONS;BYTES;OUTPUT" "")
  file(GLOB results CONFIGURE_DEPENDS ${stored_RESULTS}/*.json)
  set(code "// Made by cmake/stored_results.cmake.\nconstexpr std::string_view stored_results_json[] = {\n")
  foreach(file IN LISTS results)
    file(READ ${file} text)
    string(APPEND code "R\"json(${text})json\",\n")
  endforeach()
  file(READ ${stored_INSTRUCTIONS} text)
  string(APPEND code "};\nconstexpr std::string_view stored_instructions_json = R\"json(${text})json\";\n")
  file(READ ${stored_BYTES} text)
  string(APPEND code "constexpr std::string_view stored_bytes_json = R\"json(${text})json\";\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${results} ${stored_INSTRUCTIONS} ${stored_BYTES})
  file(CONFIGURE OUTPUT ${stored_OUTPUT} CONTENT "${code}" @ONLY)
endfunction()
