mortise_unit(pdas ROOMS base kernel scene mesh contact problem solve RANKS 1 3)
mortise_unit(solve ROOMS base kernel scene mesh contact problem solve RANKS 1 3)
mortise_unit(solvefaults ROOMS base kernel scene mesh contact problem solve RANKS 1 2 FAULTS)
mortise_unit(dissection ROOMS base kernel scene mesh contact problem solve RANKS 1 3)
