/* fileparts.h -- the mesh of all files, made by parts. */
#ifndef MORTISE_FILEPARTS_H
#define MORTISE_FILEPARTS_H

#include "mesh/fileparting.h"
#include "refinement/curves.h"

extern const FileLimits FILE_LIMITS;
/* Whether mesh files may be read and partitioned by all ranks. [in] coarser - of SceneCountCoarser() */
PetscBool FilePartsWanted(Scene scene, PetscInt coarser, PetscMPIInt num_ranks);
/* The mesh of all files, made by parts. Collective.
   [in] refine - number of later refinements; [out] good - false without a mesh: files have few cells, errors,
   or a reason for a warning */
PetscErrorCode FilePartsCreate(Scene scene, const FileLimits *limits, PetscInt refine, DM *dm, Curves *curves,
                               PetscBool *good);

#endif
