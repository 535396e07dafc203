# The manual says what the program does.
function(guide_test name)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/scratch/guide.${name})
  list(POP_FRONT ARGN what)
  add_test(NAME guide.${name} COMMAND ${MORTISE_PYTHON} -B ${PROJECT_SOURCE_DIR}/tests/guide/guide.py ${what} $<TARGET_FILE:mortise> ${folder} ${ARGN})
  set_tests_properties(guide.${name} PROPERTIES LABELS guide PROCESSORS 1 TIMEOUT ${MORTISE_TEST_TIMEOUT} ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
endfunction()

guide_test(options options)
guide_test(summary summary)
guide_test(python python)
# It runs the program both with and without mpiexec, which want other settings of a busy machine: alone, and first, because it would wait for others.
set_tests_properties(guide.python PROPERTIES RUN_SERIAL TRUE COST 100)
foreach(part RANGE 2)
  guide_test(commands_${part} commands ${part} 3)
endforeach()
