mortise_unit(scene ROOMS base kernel scene RANKS 1 2)
