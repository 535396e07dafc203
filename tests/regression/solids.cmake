# One body in space, against closed formulas.
mortise_scene_test(cantilever CHECK cantilever.py)
