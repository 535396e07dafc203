# Every file of cases/ is a test, hard.<case>: README.md here tells what its head says.
file(GLOB cases CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/cases/*.opts)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${cases}) # for their heads
foreach(path IN LISTS cases)
  get_filename_component(case ${path} NAME_WE)
  foreach(key IN ITEMS scene ranks)
    file(STRINGS ${path} line REGEX "^# ${key}: " LIMIT_COUNT 1)
    string(REGEX REPLACE "^# ${key}: " "" case_${key} "${line}")
  endforeach()
  string(REPLACE " " ";" case_ranks "${case_ranks}")
  if(NOT case_ranks)
    set(case_ranks 1)
  endif()
  set(case_options -options_file ${path})
  if(case_scene)
    mortise_find_scene(scene_file ${case_scene})
    list(PREPEND case_options -options_file ${scene_file})
  endif()
  set(options_of_${case} ${case_options}) # for others who ask something of every case
  list(FILTER case_options EXCLUDE REGEX "^-options_file$")
  list(JOIN case_options "," case_files)
  list(APPEND files_of_cases ${case_files})
  set(case_options ${options_of_${case}})
  foreach(ranks IN LISTS case_ranks)
    mortise_judged(${case} ${ranks} "" --any-end --check ${CMAKE_CURRENT_LIST_DIR}/cases.py -- ${case_options} -cross_check)
  endforeach()
endforeach()

# The table lists every case, in its own words.
add_test(NAME house.cases COMMAND ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/table.py)
set_tests_properties(house.cases PROPERTIES LABELS house)

# Every case on adaptive meshes, with its verdict.
list(LENGTH files_of_cases num_cases)
if(num_cases LESS 100)
  message(FATAL_ERROR "hard.adapted has ${num_cases} cases")
endif()
add_test(NAME hard.adapted COMMAND ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/adapted.py $<TARGET_FILE:mortise>
  ${CMAKE_CURRENT_BINARY_DIR}/scratch/hard.adapted ${files_of_cases})
set_tests_properties(hard.adapted PROPERTIES LABELS hard ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
