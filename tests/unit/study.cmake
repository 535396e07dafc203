mortise_unit(richardson LAYER study)
