mortise_unit(obstacle ROOMS base kernel mesh contact)
mortise_unit(pair ROOMS base kernel mesh contact RANKS 1 3 5)
mortise_unit(search ROOMS base kernel mesh contact RANKS 1 3 5)
mortise_unit(solidpair ROOMS base kernel mesh contact RANKS 1 3 5)
