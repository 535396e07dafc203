mortise_unit(fault ROOMS base RANKS 1 3)
mortise_unit(options ROOMS base RANKS 1 2)
mortise_unit(expression ROOMS base RANKS 1 2)
