/* levelrefine.h -- a level from a DMPlex or from the next coarser level; its positions on curved sides. */
#ifndef MORTISE_LEVELREFINE_H
#define MORTISE_LEVELREFINE_H

#include "refinement/arcsides.h"
#include "refinement/curves.h"

/* The tables and positions of a partitioned DM, cells not reversed. Collective. */
PetscErrorCode LevelCreateFromPlex(Scene scene, DM dm, const Curves *curves, Level *level);
/* Splits every cell: tables, prolongation and positions, cells not reversed. Collective.
   [in] sides - smooth ones of bodies of order 1 */
PetscErrorCode LevelRefine(Level *coarse, const ArcSides *sides, Level *fine);
/* Interpolation from node values of one order to those of a higher one on the same cells. The two scenes
   differ in the order of all bodies alone: then both have the same DMs and partition. Collective.
   [out] E - AIJ, owned by the caller */
PetscErrorCode LevelCreateEmbedding(const Level *low, const Level *high, Mat *E);
/* Sets the positions of nodes. User errors: a map that is not finite; a node with a negative radius.
   Collective.
   [in] curves - optional, may be NULL */
PetscErrorCode LevelSetCoords(Level *level, const Curves *curves);
/* Sets the positions before maps of a level that does not have them yet. Not collective. */
PetscErrorCode LevelKeepUnmapped(Level *level);
/* Finds the smooth sides on the coarsest level, and moves its middle nodes to their curves. Collective. */
PetscErrorCode LevelBeginArcs(Level *level);

#endif
