mortise_unit(loads ROOMS base kernel mesh contact problem RANKS 1 3)
mortise_unit(rigid ROOMS base kernel mesh contact problem RANKS 1 3)
mortise_unit(basis ROOMS base kernel mesh contact problem RANKS 1 3)
