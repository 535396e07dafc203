# The public interface: programs that call the library of the build, and one that is built against an installed prefix.
foreach(name calls mistakes)
  add_executable(api_${name} api/${name}.c)
  target_include_directories(api_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(api_${name} PRIVATE Mortise::mortise m)
  foreach(ranks 1 3)
    add_test(NAME api.${name}.np${ranks} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} ${MPIEXEC_PREFLAGS}
      $<TARGET_FILE:api_${name}> ${PROJECT_SOURCE_DIR}/options ${CMAKE_CURRENT_LIST_DIR} -skip_petscrc -malloc_dump COMMAND_EXPAND_LISTS)
    set(labels api)
    if(ranks EQUAL 1) # on three it takes as long as all others
      set(labels api sanitize again)
    endif()
    set_tests_properties(api.${name}.np${ranks} PROPERTIES LABELS "${labels}" PROCESSORS ${ranks} TIMEOUT ${MORTISE_TEST_TIMEOUT}
      ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
  endforeach()
endforeach()
# Nothing is left behind, and nothing is said about mistakes, which do leave memory behind.
set_tests_properties(api.calls.np1 api.calls.np3 PROPERTIES FAIL_REGULAR_EXPRESSION "${MORTISE_LEAK}")
set_tests_properties(api.mistakes.np1 api.mistakes.np3 PROPERTIES FAIL_REGULAR_EXPRESSION "mortise:|PETSC ERROR|CHECK")

# An installed prefix: the names that the library shows, the links of pages, the man pages; and a user's program in C and in C++.
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/prefix)
add_test(NAME api.install COMMAND ${CMAKE_COMMAND} --install ${CMAKE_BINARY_DIR} --prefix ${prefix})
set_tests_properties(api.install PROPERTIES LABELS api FIXTURES_SETUP prefix)
set(checks symbols files pkgconfig_c cmake_cxx)
if(MORTISE_TEST_LONG)
  list(APPEND checks pkgconfig_cxx cmake_c)
endif()
if(EXISTS ${PROJECT_SOURCE_DIR}/options/GUIDE.md)
  file(STRINGS ${PROJECT_SOURCE_DIR}/options/GUIDE.md page REGEX "^// loads.c: ") # the program of its chapter on C
  if(page)
    list(APPEND checks guide)
  endif()
endif()
foreach(what IN LISTS checks)
  add_test(NAME api.${what} COMMAND ${MORTISE_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/installed_library.py ${what} --prefix ${prefix}
    --libdir ${CMAKE_INSTALL_LIBDIR} --mpiexec ${MPIEXEC_EXECUTABLE} --cmake ${CMAKE_COMMAND} --source ${PROJECT_SOURCE_DIR}
    --program $<TARGET_FILE:mortise> --scratch ${CMAKE_CURRENT_BINARY_DIR}/scratch/api.${what})
  set_tests_properties(api.${what} PROPERTIES LABELS api FIXTURES_REQUIRED prefix TIMEOUT ${MORTISE_TEST_TIMEOUT} ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
  if(MORTISE_SANITIZE) # a program of others has none
    set_tests_properties(api.${what} PROPERTIES DISABLED TRUE)
  endif()
endforeach()
