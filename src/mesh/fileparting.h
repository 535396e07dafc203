/* fileparting.h -- the ranks of cells of files. */
#ifndef MORTISE_FILEPARTING_H
#define MORTISE_FILEPARTING_H

#include "mesh/filecells.h"

/* Least number of cells of files that all ranks connect: a smaller mesh needs little memory on one rank.
   Least number that all ranks partition as well: METIS takes some 200 bytes for each cell on the first
   rank. */
typedef struct {
  PetscInt parts, parallel;
} FileLimits;

/* The rank of each cell. Collective. [in] refine - how often the mesh will be; [out] part - [cells->num] */
PetscErrorCode FileCellsPart(Scene scene, const Files *files, const FileCells *cells, const FileLimits *limits,
                             PetscInt refine, PetscInt part[]);

#endif
