# The reader of presets/ accepts a valid file and reports each error with one line. The script runs
# itself for each file.
#
# usage: cmake -D SOURCE=... -D WORK=... -P sea_presets_reader_test.cmake
cmake_minimum_required(VERSION 3.25)
if(DEFINED FOLDER)
  include(${SOURCE}/cmake/sea_presets.cmake)
  pelagic_sea_members(${SOURCE}/sim/sea_state.hpp members)
  pelagic_read_sea_preset(${FOLDER}/sea.toml sea ${SOURCE}/sim/sea_state.hpp code)
  message("${code}")
  return()
endif()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
# usage: read(TEXT WORKS EXPECTED): the output contains EXPECTED.
function(read text works expected)
  file(WRITE ${WORK}/sea.toml "${text}")
  execute_process(COMMAND ${CMAKE_COMMAND} -D SOURCE=${SOURCE} -D FOLDER=${WORK} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
                  RESULT_VARIABLE result ERROR_VARIABLE said OUTPUT_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  string(FIND "${said}" "${expected}" at)
  if((result EQUAL 0 AND NOT works) OR (NOT result EQUAL 0 AND works) OR at EQUAL -1)
    message(SEND_ERROR "of\n${text}it says ${result}: ${said}\nneeds ${expected}")
  endif()
endfunction()

set(first "# sea: a sea, [Hs 1 m\n")
read("${first}\nseed = 7  # any\n# odd ] ; words\nspectrum = \"pierson-moskowitz\"\nwind_direction = -22.5\nfetch = 2e6\n" TRUE
     "SeaPreset{\"sea\", \"a sea, [Hs 1 m\", {.spectrum = SpectrumModel::pierson_moskowitz, .wind_direction_rad = -22.5 * (3.14159265358979323846 / 180), .fetch_m = 2e6, .seed = 7}},")
read("seed = 1\n" FALSE "sea.toml:1: the first line is seed = 1")
read("# other: a sea\n" FALSE "expected # sea: and a summary")
read("${first}wind_sped = 3\n" FALSE "sea.toml:2: unknown key wind_sped")
read("${first}wind_speed_mps = 3\n" FALSE "unknown key wind_speed_mps")
read("${first}seed = 1\nseed = 2\n" FALSE "sea.toml:3: seed is given twice")
read("${first}wind_speed = \"20kn\"\n" FALSE "wind_speed is \"20kn\", expected a number")
read("${first}wind_speed = 3;4\n" FALSE "expected a number")
read("${first}wind_speed = 0x10\n" FALSE "expected a number")
read("${first}wind_speed =\n" FALSE "expected lines such as")
read("${first}[sea]\n" FALSE "expected lines such as")
read("${first}spectrum = \"jonsawp\"\n" FALSE "expected one of enum class SpectrumModel")
read("${first}spectrum = 3\n" FALSE "expected one of")
read("${first}seed = 1" FALSE "the last line has no end")
