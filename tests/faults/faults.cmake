# What the world does to a run: signals, a rank that dies, a full disk, too little memory, nobody who reads what is printed.
mortise_scene_test(interrupted SCENE two_plates CHECK interrupted.py RANKS 1 3 ONLY_RANKS "one rank gets the signal, or several do")
math(EXPR patience "4 * ${MORTISE_TEST_TIMEOUT}") # a dozen runs in one test
foreach(ranks IN ITEMS 1 3)
  set_tests_properties(faults.interrupted.np${ranks} PROPERTIES TIMEOUT ${patience})
endforeach()
mortise_scene_test(full SCENE two_plates CHECK full.py ONLY_RANKS "limits are those of one process")
mortise_scene_test(memory SCENE two_plates CHECK memory.py ONLY_RANKS "limits are those of one process"
  UNSANITIZED "address sanitizer takes terabytes of addresses, so that no limit of addresses can be set")
mortise_scene_test(no_solution SCENE overhang CHECK no_solution.py)
