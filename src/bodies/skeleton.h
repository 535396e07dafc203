/* skeleton.h -- facets of cells, and edges of facets in space. Nothing is collective. */
#ifndef MORTISE_SKELETON_H
#define MORTISE_SKELETON_H

#include <petscdmplex.h>

#include "kernel/element.h"

/* Shapes of one dimension. Each has a list of vertices in PETSc's order and, after ShapesBound(), one of its
   facets. */
typedef struct {
  PetscInt  num;
  PetscInt *type;                            /* ElementType of order 1 [num] */
  PetscInt *start, *vertex;                  /* [num+1], [start[num]] */
  PetscInt *cone_start, *cone, *orientation; /* NULL before ShapesBound() [num+1], [cone_start[num]] twice */
} Shapes;

/* Allocates shapes for ShapesAdd(). */
PetscErrorCode ShapesCreate(PetscInt max_shapes, PetscInt max_vertices, Shapes *shapes);
PetscErrorCode ShapesDestroy(Shapes *shapes);
void           ShapesAdd(Shapes *shapes, ElementType type, const PetscInt vertices[]);
/* The facets of shapes, each once: those of the first shape first.
   [in] num_vertices - of vertices from 0; [out] lower - owned by the caller */
PetscErrorCode ShapesBound(Shapes *upper, PetscInt num_vertices, Shapes *lower);
/* PETSc's names of the cells of order 1 [ELEMENT_COUNT]. */
extern const DMPolytopeType PlexPolytope[];

#endif
