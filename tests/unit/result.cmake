mortise_unit(output ROOMS base kernel scene mesh contact problem result RANKS 1 3)
mortise_unit(stress ROOMS base kernel scene mesh contact problem solve result RANKS 1 3)
mortise_unit(certificate ROOMS base kernel scene mesh contact problem solve result RANKS 1 4)
mortise_unit(errors ROOMS base kernel scene mesh contact problem result RANKS 1 3)
