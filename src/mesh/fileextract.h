/* fileextract.h -- from the mesh of a file to the lists of a body. All of it is on the first rank, nothing is
   collective. */
#ifndef MORTISE_FILEEXTRACT_H
#define MORTISE_FILEEXTRACT_H

#include "mesh/meshimpl.h"

typedef struct {
  const SceneBody *body;
  const GmshNames *names;
  struct _n_Scene  scene; /* of this body alone, before its map, with all cells of the file */
  SceneBody        alone;
  Level            level; /* with the body's own refinements */
  PetscInt         cell_begin, num_cells, num_vertices, num_nodes;
  PetscInt        *cell_at; /* position of each cell in the lists, -1 for other regions */
  PetscInt        *node_at; /* likewise of each of the level's nodes */
} Extract;

/* The indices of one stratum of a label, or of the label's values with tag < 0; sorted copies. */
PetscErrorCode LabelGetPoints(DM dm, const char name[], PetscInt tag, PetscInt *num, PetscInt **points);
/* The kind of a group of another dimension with this name or number, NULL if there is none.
   [in] wanted - the right dimension */
PetscErrorCode ExtractFindOther(const Extract *x, PetscInt wanted, const char group[], const char **kind);
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
/* Checks that no two cells overlap. [out] sentence - "" if so [MESH_SENTENCE] */
PetscErrorCode ExtractCheckFacets(const Extract *x, const BodyList *list, char sentence[]);
/* Checks that a body has no cell of its file in common with an earlier body in the same place.
   [out] sentence - untouched if so [MESH_SENTENCE] */
PetscErrorCode SharedCellsCheck(Scene scene, PetscInt body, const MeshFile file, char sentence[]);
/* list->num_nonmanifold and list->nonmanifold. */
PetscErrorCode NonManifoldFind(const Extract *x, BodyList *list);
/* list->unjoined, after the sides: components that touch, except those that a pair of the body with itself
   joins. */
PetscErrorCode UnjoinedPiecesFind(const Extract *x, Scene scene, PetscInt body, const SideNames *names, BodyList *list);
/* All sides that the scene names. A facet counts once in each of them.
   [out] sentence - "" unless there is a mistake */
PetscErrorCode ExtractSides(const Extract *x, const SideNames *names, BodyList *list, char sentence[]);
/* Sides that are taken for smooth on the level as it is; positions before the map are kept where there are
   some. [out] sides - owned by the caller */
PetscErrorCode ExtractArcSides(Extract *x, Scene scene, PetscInt body, ArcSides *sides);
/* The same for a file of second order: which facets are on arcs; their middle nodes after a refinement. */
PetscErrorCode ExtractMarkParabolas(Extract *x, Scene scene, PetscInt body);
PetscErrorCode ExtractCurveMiddles(Extract *x, Scene scene, PetscInt body);

#endif
