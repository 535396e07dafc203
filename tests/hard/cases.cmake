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
  foreach(ranks IN LISTS case_ranks)
    mortise_judged(${case} ${ranks} "" --any-end --check ${CMAKE_CURRENT_LIST_DIR}/cases.py -- ${case_options} -cross_check)
  endforeach()
endforeach()

# The table lists every case, in its own words.
add_test(NAME house.cases COMMAND ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/table.py)
set_tests_properties(house.cases PROPERTIES LABELS house)
