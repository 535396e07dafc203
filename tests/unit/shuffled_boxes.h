/* shuffled_boxes.h -- boxes of all types of cells with nodes in any order, for tests of the points of a DMPlex. */
#ifndef MORTISE_SHUFFLED_BOXES_H
#define MORTISE_SHUFFLED_BOXES_H

#include "bodies/box.h"
#include "bodies/plexlist.h"
#include "solid_scene.h"

/* The same numbers everywhere. */
static inline PetscInt Random(PetscInt below)
{
  static unsigned state = 1;

  state = 1103515245u * state + 12345u;
  return (PetscInt)((state >> 16) % (unsigned)below);
}

/* Other numbers for the nodes, and in simplices another first vertex, so that facets meet in all their orientations. */
static inline void Shuffle(BodyList *list)
{
  PetscInt *number;

  CHECK(!PetscMalloc1(list->num_nodes, &number));
  for (PetscInt i = 0; i < list->num_nodes; ++i) number[i] = i;
  for (PetscInt i = list->num_nodes - 1; i > 0; --i) {
    const PetscInt j = Random(i + 1), swap = number[i];

    number[i] = number[j];
    number[j] = swap;
  }
  for (PetscInt c = 0; c < list->num_cells; ++c) {
    PetscInt *nodes = &list->cell_nodes[c * ELEMENT_MAX_NODES];

    for (PetscInt i = 0; i < ElementNumNodes((ElementType)list->cell_type[c]); ++i) nodes[i] = number[nodes[i]];
    for (PetscInt turns = Random(3); turns > 0 && ElementNumFacets((ElementType)list->cell_type[c]) <= 4; --turns) {
      const PetscInt first = nodes[0];

      if (list->cell_type[c] == ELEMENT_QUAD4) continue;
      nodes[0] = nodes[1];
      nodes[1] = nodes[2];
      nodes[2] = first;
    }
  }
  CHECK(!PetscFree(number));
}

/* Every point has the same type, the same facets and the same orientations of them. */
static inline void CheckSame(DM a, DM b)
{
  DM       dm[2] = {a, b};
  PetscInt begin[2], end[2];

  for (int k = 0; k < 2; ++k) CHECK(!DMPlexGetChart(dm[k], &begin[k], &end[k]));
  CHECK(begin[0] == begin[1] && end[0] == end[1]);
  for (PetscInt p = begin[0]; p < end[0]; ++p) {
    const PetscInt *cone[2], *orientation[2];
    DMPolytopeType  type[2];
    PetscInt        size[2];

    for (int k = 0; k < 2; ++k) {
      CHECK(!DMPlexGetConeSize(dm[k], p, &size[k]));
      CHECK(!DMPlexGetCone(dm[k], p, &cone[k]));
      CHECK(!DMPlexGetConeOrientation(dm[k], p, &orientation[k]));
      CHECK(!DMPlexGetCellType(dm[k], p, &type[k]));
    }
    CHECK(size[0] == size[1] && type[0] == type[1]);
    for (PetscInt i = 0; i < size[0]; ++i) CHECK(cone[0][i] == cone[1][i] && orientation[0][i] == orientation[1][i]);
  }
}

/* Quads and triangles, or hexahedra and tetrahedra. Not collective. [out] lists - [2], each owned by the caller */
static inline void MakeShuffledBoxes(PetscInt dim, BodyList lists[])
{
  const SideNames none                    = {0, NULL};
  SceneBody       body                    = {.name = (char *)"box", .faces = {3, 4, 5}, .upper = {1, 1, 1}};
  char            sentence[MESH_SENTENCE] = "";

  for (int k = 0; k < 2; ++k) {
    body.simplex = k ? PETSC_TRUE : PETSC_FALSE;
    CHECK(!BodyListCreateBox(&body, dim, &none, NULL, &lists[k], sentence));
    Shuffle(&lists[k]);
  }
}

#endif
