/* simplices.h -- quads and hexahedra as triangles and tetrahedra. Nothing is collective. */
#ifndef MORTISE_SIMPLICES_H
#define MORTISE_SIMPLICES_H

#include "bodies/bodylist.h"

/* Whether a list's cells can be split: all are quadrilaterals, or all hexahedra. */
PetscBool BodyListCanSplit(const BodyList *list);
/* Cuts quadrilaterals at their shorter diagonal, and hexahedra so that each face is cut at its lowest vertex:
   then neighbours match. [in,out] list; [out] cut - whether there were such cells */
PetscErrorCode BodyListCut(const SceneBody *body, BodyList *list, PetscBool *cut);

#endif
