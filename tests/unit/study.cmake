mortise_unit(richardson ROOMS base kernel scene mesh contact problem solve result study)
