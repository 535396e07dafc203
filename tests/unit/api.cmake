mortise_unit(process LAYER api RANKS 2)
