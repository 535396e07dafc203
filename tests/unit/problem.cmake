mortise_unit(loads LAYER problem RANKS 1 3 SANITIZED 1)
mortise_unit(symmetricblocks LAYER problem)
mortise_unit(congruentcells LAYER problem)
mortise_unit(basis LAYER rigid RANKS 1 3)
