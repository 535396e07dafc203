/* curvedfile.h -- the curves of files of second order, by the middle nodes of their cells. */
#ifndef MORTISE_CURVEDFILE_H
#define MORTISE_CURVEDFILE_H

#include "bodies/bodylist.h"
#include "bodies/plexlist.h"
#include "refinement/curves.h"

/* The curves of a DM, from the cells of order 2 in lists. Collective on the DM. */
PetscErrorCode CurvesCreate(DM dm, const BodyList lists[], const Numbering *numbering, Curves *curves);

#endif
