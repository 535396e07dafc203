mortise_scene_test(interface CHECK interface.py RANKS 1 3 LABELS sanitize ARGS -output_format xdmf,vtu)
