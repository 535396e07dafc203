/* staleplots.h -- removal of plots of an earlier run. */
#ifndef MORTISE_STALEPLOTS_H
#define MORTISE_STALEPLOTS_H

#include "output/fileset.h"

/* Will remove <output>.png, <output>_study.svg, <output>_steps.png and <output>.html of mortise-plot and
   mortise-report when the files appear: they show an earlier result. First rank only. */
PetscErrorCode StalePlotsRemove(FileSet *files, const char output[]);

#endif
