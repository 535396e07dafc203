/* fileextract.h -- the cells and nodes of a body in the mesh of its file. All of it is on the first rank. */
#ifndef MORTISE_FILEEXTRACT_H
#define MORTISE_FILEEXTRACT_H

#include "gmsh/gmsh.h"
#include "level/level.h"

typedef struct {
  const SceneBody *body;
  const GmshNames *names;
  struct _n_Scene  scene; /* of this body alone, before its map, with all cells of the file */
  SceneBody        alone;
  Level            level; /* with refinements before all bodies are merged */
  PetscInt         cell_begin, num_cells, num_vertices, num_nodes;
  PetscInt        *cell_at; /* position of each cell in the lists, -1 for other regions */
  PetscInt        *node_at; /* likewise of each of the level's nodes */
} Extract;

/* The indices of one stratum of a label, or of the label's values with tag < 0; sorted copies. */
PetscErrorCode LabelGetPoints(DM dm, const char name[], PetscInt tag, PetscInt *num, PetscInt **points);
/* The kind of a group of another dimension with this name or number, NULL if there is none.
   [in] wanted - the right dimension */
PetscErrorCode ExtractFindOther(const Extract *x, PetscInt wanted, const char group[], const char **kind);

#endif
