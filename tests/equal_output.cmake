# Two programs print the same with one argument:
#   cmake -D FIRST=PROGRAM -D SECOND=PROGRAM -D ARGUMENT=TEXT -P equal_output.cmake
foreach(program FIRST SECOND)
  execute_process(COMMAND ${${program}} ${ARGUMENT} OUTPUT_VARIABLE output_${program} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(output_FIRST STREQUAL "" OR NOT output_FIRST STREQUAL output_SECOND)
  message(FATAL_ERROR "${FIRST} prints\n${output_FIRST}\nand ${SECOND}\n${output_SECOND}")
endif()
