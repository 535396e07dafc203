# The Python package: without the program; with it; as CMake installs it, and, in the long run, as pip does.
set(python_test ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/package.py)
set(python_arguments --program $<TARGET_FILE:mortise> --prefix ${CMAKE_CURRENT_BINARY_DIR}/prefix --version ${PROJECT_VERSION})
set(python_tests plain runs failures interrupt sweep installed)
if(MORTISE_TEST_LONG)
  list(APPEND python_tests pip)
endif()
foreach(what IN LISTS python_tests)
  add_test(NAME python.${what} COMMAND ${python_test} ${what} ${python_arguments} --scratch ${CMAKE_CURRENT_BINARY_DIR}/scratch/python.${what})
  set_tests_properties(python.${what} PROPERTIES LABELS python TIMEOUT ${MORTISE_TEST_TIMEOUT}
    ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT};MPIEXEC=${MPIEXEC_EXECUTABLE};MORTISE=$<TARGET_FILE:mortise>")
endforeach()
set_tests_properties(python.runs python.failures PROPERTIES PROCESSORS 2)
set_tests_properties(python.installed PROPERTIES FIXTURES_REQUIRED prefix)
execute_process(COMMAND ${MORTISE_PYTHON} -c "import setuptools, wheel, ensurepip, pip, venv" RESULT_VARIABLE lacks_pip OUTPUT_QUIET ERROR_QUIET)
if(MORTISE_TEST_LONG AND (lacks_pip OR MORTISE_SANITIZE)) # of Debian: python3-pip, python3-setuptools, python3-venv, python3-wheel
  set_tests_properties(python.pip PROPERTIES DISABLED TRUE)
endif()
if(MORTISE_SANITIZE) # nothing of C is tested by it
  set_tests_properties(python.installed PROPERTIES DISABLED TRUE)
endif()
