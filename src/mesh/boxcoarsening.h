/* boxcoarsening.h -- coarser levels of boxes, and of files with refinements of their own. */
#ifndef MORTISE_BOXCOARSENING_H
#define MORTISE_BOXCOARSENING_H

#include "scene/scene.h"

/* Number of coarser levels: how often the cells of all bodies can be twice as large, of boxes if solvers use
   levels. Edges of a file become twice as long by one refinement less.
   [in] num_ranks - that share the coarsest mesh */
PetscInt SceneCountCoarser(Scene scene, PetscMPIInt num_ranks);
/* Doubles the edges of the cells `times` times, first by fewer refinements. */
void BodyCoarsen(SceneBody *body, PetscInt dim, PetscInt times);

#endif
