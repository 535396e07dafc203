/* boxcoarsening.h -- coarser levels of boxes. */
#ifndef MORTISE_BOXCOARSENING_H
#define MORTISE_BOXCOARSENING_H

#include "scene/scene.h"

/* Number of coarser levels of boxes: how often the cells of all bodies can be twice as large, if solvers use
   levels.
   [in] num_ranks - that share the coarsest mesh */
PetscInt SceneCountCoarser(Scene scene, PetscMPIInt num_ranks);
/* Doubles the edges of the cells of a box `times` times. */
void BodyCoarsen(SceneBody *body, PetscInt dim, PetscInt times);

#endif
