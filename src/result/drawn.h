/* drawn.h -- what the companions drew of an earlier run (private to the room). */
#ifndef MORTISE_DRAWN_H
#define MORTISE_DRAWN_H

#include "files.h"

/* Will remove <output>.png and <output>.html when the files appear, if mortise-plot and mortise-report made them: beside a
   new result they would show another one. First rank only. */
PetscErrorCode DrawnRemove(Files *files, const char output[]);

#endif
