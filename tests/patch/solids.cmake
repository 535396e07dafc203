# One body in space, without contact.
mortise_scene_test(solid CHECK solid.py RANKS 1 3)
mortise_scene_test(buoyant CHECK buoyant.py RANKS 1 2)
