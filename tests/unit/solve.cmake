mortise_unit(pdas ROOMS base solve RANKS 1 2 3)
