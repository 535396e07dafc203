mortise_unit(richardson LAYER study)
mortise_unit(extend LAYER study RANKS 1 LONG_RANKS 2 3)
mortise_unit(adaptpatch LAYER study RANKS 1 3 SANITIZED 1)
