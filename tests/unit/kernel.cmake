# Floor 1 needs nothing below it: plain arrays on one rank.
mortise_unit(element ROOMS kernel)
mortise_unit(material ROOMS kernel)
mortise_unit(dense ROOMS kernel)
mortise_unit(dual ROOMS kernel)
mortise_unit(clip ROOMS kernel)
mortise_unit(frame ROOMS kernel)
mortise_unit(boxtree ROOMS kernel)
