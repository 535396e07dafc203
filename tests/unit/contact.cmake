mortise_unit(pair ROOMS base kernel mesh contact RANKS 1 2 3 5)
