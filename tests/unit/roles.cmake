mortise_unit(orient ROOMS base kernel mesh RANKS 1 3)
