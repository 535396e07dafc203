# What cmake --install puts under a prefix works from there: the program finds its scenes' meshes and its companions.
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/installed)
add_test(NAME hard.install COMMAND ${CMAKE_COMMAND} --install ${CMAKE_BINARY_DIR} --prefix ${prefix})
add_test(NAME hard.installed COMMAND ${MORTISE_PYTHON} -B ${PROJECT_SOURCE_DIR}/tests/judge.py
  --program ${prefix}/${CMAKE_INSTALL_BINDIR}/mortise --scratch ${CMAKE_CURRENT_BINARY_DIR}/scratch/hard.installed
  --check ${CMAKE_CURRENT_LIST_DIR}/installed.py
  -- -options_file ${prefix}/${CMAKE_INSTALL_DATADIR}/mortise/options/punch.opts -report)
set_tests_properties(hard.install PROPERTIES LABELS hard FIXTURES_SETUP installed)
set_tests_properties(hard.installed PROPERTIES LABELS hard FIXTURES_REQUIRED installed ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
