# Scenes that are set up wrong. Every file of cases/ is a test, unset.<case>: unset.py here tells what its head says.
file(GLOB cases CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/cases/*.opts ${CMAKE_CURRENT_LIST_DIR}/cases/*.py)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${cases}) # for their heads
foreach(path IN LISTS cases)
  get_filename_component(case ${path} NAME_WE)
  file(STRINGS ${path} line REGEX "^# ranks: " LIMIT_COUNT 1)
  string(REGEX REPLACE "^# ranks: " "" case_ranks "${line}")
  string(REPLACE " " ";" case_ranks "${case_ranks}")
  if(NOT case_ranks)
    set(case_ranks 1)
  endif()
  foreach(ranks IN LISTS case_ranks)
    set(test unset.${case}.np${ranks})
    add_test(NAME ${test} COMMAND ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/unset.py $<TARGET_FILE:mortise> ${MPIEXEC_EXECUTABLE}
      ${ranks} ${CMAKE_CURRENT_BINARY_DIR}/scratch/${test} ${path})
    set_tests_properties(${test} PROPERTIES LABELS unset PROCESSORS ${ranks} TIMEOUT ${MORTISE_TEST_TIMEOUT} ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
  endforeach()
endforeach()
