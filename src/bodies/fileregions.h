/* fileregions.h -- cells of a file by their physical groups: those that form a body, and its regions.
   Nothing is collective. */
#ifndef MORTISE_FILEREGIONS_H
#define MORTISE_FILEREGIONS_H

#include "bodies/bodylist.h"
#include "bodies/fileextract.h"

/* Marks the cells of physical groups (names or numbers joined with '+'), or with NULL all. [out] chosen - of
   all cells of the DM; [out] lacking - the first group without any, "" if there is none [MESH_SENTENCE]; or
   NULL */
PetscErrorCode RegionMark(DM dm, const GmshNames *names, const char groups[], PetscBool chosen[], char lacking[]);
/* x->cell_at and x->num_cells: the cells of the body's -<body>_mesh_region. [out] sentence - untouched if
   there are some [MESH_SENTENCE] */
PetscErrorCode ExtractSelect(Extract *x, char sentence[]);
/* list->cell_material of a body that has regions: each of its cells is in one of them at most. [out] sentence
   - untouched if there is no mistake [MESH_SENTENCE] */
PetscErrorCode ExtractRegions(const Extract *x, Scene scene, PetscInt body, BodyList *list, char sentence[]);

#endif
