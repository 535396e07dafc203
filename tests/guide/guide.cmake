# The manual says what the program does.
foreach(what options summary commands python)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/scratch/guide.${what})
  add_test(NAME guide.${what} COMMAND ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/guide.py ${what} $<TARGET_FILE:mortise> ${folder})
  set_tests_properties(guide.${what} PROPERTIES LABELS guide PROCESSORS 1 TIMEOUT ${MORTISE_TEST_TIMEOUT} ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
endforeach()
