/* filesides.h -- the sides of a body from the mesh of its file. Nothing is collective. */
#ifndef MORTISE_FILESIDES_H
#define MORTISE_FILESIDES_H

#include "bodies/bodylist.h"
#include "bodies/fileextract.h"

/* Checks that no two cells overlap. [out] sentence - "" if so [MESH_SENTENCE] */
PetscErrorCode ExtractCheckFacets(const Extract *x, const BodyList *list, char sentence[]);
/* All sides that the scene names. A facet counts once in each of them.
   [out] sentence - "" unless there is a mistake */
PetscErrorCode ExtractSides(const Extract *x, const SideNames *names, BodyList *list, char sentence[]);

#endif
