mortise_unit(mesh ROOMS base kernel mesh RANKS 1 2 3 4)
