/* fileconnect.h -- neighbours of cells, and the physical groups of their facets. */
#ifndef MORTISE_FILECONNECT_H
#define MORTISE_FILECONNECT_H

#include "mesh/filecells.h"

/* Finds neighbours and groups of facets. Collective. [in,out] good */
PetscErrorCode FileCellsConnect(const Files *files, FileCells *cells, PetscBool *good);
/* Whether a facet is of a side. */
PetscBool FileCellsHasSide(const Files *files, const FileCells *cells, PetscInt cell, PetscInt facet, PetscInt tag);

#endif
