/* box.h -- a box of quadrilaterals, triangles, hexahedra or tetrahedra. Nothing is collective. */
#ifndef MORTISE_BOX_H
#define MORTISE_BOX_H

#include "bodies/bodylist.h"

/* The bricks of a box that a rank makes, by their numbers in the box, x first. */
typedef struct {
  PetscInt  num_bricks, num_nodes;
  PetscInt *brick, *node; /* ascending [num_bricks], [num_nodes] */
} BoxPart;

/* A box of quads or triangles, of hexahedra or tetrahedra, or a part of it. [in] part - or NULL; [out]
   sentence - [MESH_SENTENCE], "" unless the scene is wrong */
PetscErrorCode BodyListCreateBox(const SceneBody *body, PetscInt dim, const SideNames *names, const BoxPart *part,
                                 BodyList *list, char sentence[]);

#endif
