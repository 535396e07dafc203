# Bodies that only contact can hold, and loads that it cannot.
mortise_scene_test(held SCENE block CHECK held.py ARGS -cross_check)
mortise_scene_test(refused SCENE block CHECK refused.py RANKS 1 3)
mortise_scene_test(pile SCENE stack CHECK weights.py RANKS 1 2)
mortise_scene_test(pile_cg SCENE stack CHECK weights.py ARGS -ksp_type cg -ksp_rtol 1e-12 -cross_check)
mortise_scene_test(pile_quadratic SCENE stack CHECK weights.py ARGS -order 2 -snes_type vinewtonrsls)
mortise_scene_test(tower CHECK weights.py RANKS 1 3 ARGS -cross_check)
mortise_scene_test(pieces CHECK pieces.py RANKS 1 3 ARGS -cross_check)
