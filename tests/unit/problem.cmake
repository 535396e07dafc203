mortise_unit(loads LAYER problem RANKS 1 3)
mortise_unit(rigid LAYER problem RANKS 1 3)
mortise_unit(basis LAYER problem RANKS 1 3)
