/* staleplots.h -- removal of plots of an earlier run. */
#ifndef MORTISE_STALEPLOTS_H
#define MORTISE_STALEPLOTS_H

#include "output/fileset.h"

/* Will remove <output>.png, <output>_study.svg, <output>_steps.png and <output>.html when the files appear,
   if mortise-plot and mortise-report made them: beside a new result they would show another one. First rank
   only. */
PetscErrorCode StalePlotsRemove(FileSet *files, const char output[]);

#endif
