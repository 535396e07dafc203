mortise_unit(loads LAYER problem RANKS 1 LONG_RANKS 3)
mortise_unit(symmetricblocks LAYER problem)
mortise_unit(congruentcells LAYER problem)
mortise_unit(basis LAYER rigid RANKS 1 3)
