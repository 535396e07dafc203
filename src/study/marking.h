/* marking.h -- which cells are refined. */
#ifndef MORTISE_MARKING_H
#define MORTISE_MARKING_H

#include "result/estimate.h"

/* Marks the cells of largest eta_T^2 whose sum is a share of that of all cells (Dorfler 1996). These may make
   the mesh grow little: kept quadrilaterals of order 2, or a fine mesh with large errors at few places. Where
   eta is small, more are marked then, the largest first. For this the marked ones count as halved, with a
   quarter of their eta_T^2: a cell may get several marks. Cells whose values differ by less than one per
   cent are marked together. So symmetric scenes stay symmetric, and marks do not depend on the number of
   ranks. In meshes of simplices, marks of four to eight rounds are graded to vertices: few cells near
   singular points hold the error there. Collective.
   [in] cell - eta_T^2 [num_cells]; [in] norm - |u|_a^2, in the same scale;
   [in] least - whether cells are marked again for the least growth alone;
   [out] marked - how often edges are to be halved, -n for graded marks, as of MeshAdapt() [num_cells], owned
   by the caller;
   [out] growth - expected, of the number of cells; NULL if not wanted */
PetscErrorCode MarkingCreate(const Level *level, const PetscReal cell[], PetscReal norm, PetscReal share,
                             PetscBool least, PetscInt **marked, PetscReal *growth);

#endif
