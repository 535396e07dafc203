mortise_scene_test(full CHECK full.py RANKS 1 2 4)
mortise_scene_test(narrow CHECK uniform.py RANKS 1 3)
mortise_scene_test(wide CHECK wide.py RANKS 1 2)
mortise_scene_test(crosspoints CHECK uniform.py RANKS 1 2 4)
mortise_scene_test(sectors CHECK hydrostatic.py RANKS 1 2 3)
mortise_mistake(circle SCENE sectors SAYS "ab, bc, ac" "circle" "swap"
  ARGS -ac_nonmortar c:left -ac_mortar a:bottom)
