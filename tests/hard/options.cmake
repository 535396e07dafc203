# The front door: what is said before there is a scene, and mistakes that PETSc is the first to see.
add_test(NAME hard.version COMMAND mortise -version)
add_test(NAME hard.help COMMAND mortise -help)
add_test(NAME hard.usage COMMAND mortise)
set_tests_properties(hard.version hard.help hard.usage PROPERTIES LABELS hard ENVIRONMENT "${MORTISE_TEST_ENVIRONMENT}")
set_tests_properties(hard.version PROPERTIES PASS_REGULAR_EXPRESSION "^mortise [0-9.]+\nPETSc 3")
set_tests_properties(hard.help PROPERTIES PASS_REGULAR_EXPRESSION "-<body>_young")
set_tests_properties(hard.usage PROPERTIES PASS_REGULAR_EXPRESSION "^mortise: no scene given")

mortise_mistake(no_file_name SAYS -options_file "name of a file" ARGS -options_file -quiet)
mortise_mistake(binary_file SAYS "not a text file" ARGS -options_file ${MORTISE_PYTHON})
mortise_mistake(number_of_petsc SCENE two_plates SAYS -ksp_rtol abc ARGS -ksp_rtol abc)
mortise_mistake(type_of_petsc SCENE two_plates SAYS -pc_type zoo ARGS -pc_type zoo)
mortise_mistake(bool_of_petsc SCENE two_plates SAYS -malloc_debug zoo ARGS -malloc_debug zoo)
