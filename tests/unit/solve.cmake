mortise_unit(pdas ROOMS base solve RANKS 1 3)
mortise_unit(solve ROOMS base solve RANKS 1 3)
mortise_unit(solvefaults ROOMS base solve RANKS 1 2 FAULTS)
