mortise_unit(orient LAYER mesh RANKS 1 3)
