mortise_unit(output ROOMS base kernel scene mesh contact problem result RANKS 1 3)
