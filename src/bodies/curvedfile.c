/* curvedfile.c -- the middle nodes of files of second order: positions, before any map, on edges, facets and
   cells of a DM. Points without a position are straight. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/curvedfile.h"
#include "bodies/plexlist.h"
#include "level/plexpoints.h"

/* The points that carry the nodes behind a cell's vertices, in the order of element.h: edges, facets, the
   cell itself.
   [out] num - 0 for a cell of order 1; points - [ELEMENT_MAX_NODES] */
static PetscErrorCode CellGetMiddles_Private(DM dm, const BodyList *list, const Numbering *numbering, PetscInt body,
                                             PetscInt cell, PetscInt *num, PetscInt points[])
{
  const ElementType type = (ElementType)list->cell_type[cell];
  PetscInt          vertices[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  *num = 0;
  if (ElementOrder(type) == 1) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < ElementNumNodes(ElementLinear(type)); i++)
    vertices[i] = numbering->first_vertex[body] + list->cell_nodes[cell * ELEMENT_MAX_NODES + i];
  PetscCall(PointGetMiddles(dm, numbering->point[body][cell], vertices, num, points));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* dim numbers on every point that a list has a middle node on. */
static PetscErrorCode CurvesSetSection_Private(DM dm, const BodyList lists[], const Numbering *numbering,
                                               PetscSection section)
{
  PetscInt begin, end, num, points[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  PetscCall(DMPlexGetChart(dm, &begin, &end));
  PetscCall(PetscSectionSetChart(section, begin, end));
  for (PetscInt b = 0; b < numbering->num_bodies; b++) {
    for (PetscInt c = 0; c < lists[b].num_cells; c++) {
      PetscCall(CellGetMiddles_Private(dm, &lists[b], numbering, b, c, &num, points));
      for (PetscInt i = 0; i < num; i++) PetscCall(PetscSectionSetDof(section, points[i], lists[b].dim));
    }
  }
  PetscCall(PetscSectionSetUp(section));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CurvesCreate(DM dm, const BodyList lists[], const Numbering *numbering, Curves *curves)
{
  PetscInt     size, num, points[ELEMENT_MAX_NODES];
  PetscScalar *x;

  PetscFunctionBeginUser;
  PetscCall(PetscSectionCreate(PetscObjectComm((PetscObject)dm), &curves->section));
  PetscCall(CurvesSetSection_Private(dm, lists, numbering, curves->section));
  PetscCall(PetscSectionGetStorageSize(curves->section, &size));
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, size, &curves->positions));
  PetscCall(VecGetArray(curves->positions, &x));
  for (PetscInt b = 0; b < numbering->num_bodies; b++) {
    const BodyList *list = &lists[b];

    for (PetscInt c = 0; c < list->num_cells; c++) {
      const ElementType type   = (ElementType)list->cell_type[c];
      const PetscInt   *middle = &list->cell_nodes[c * ELEMENT_MAX_NODES] + ElementNumNodes(ElementLinear(type));

      PetscCall(CellGetMiddles_Private(dm, list, numbering, b, c, &num, points));
      for (PetscInt i = 0; i < num; i++) {
        PetscInt offset;

        PetscCall(PetscSectionGetOffset(curves->section, points[i], &offset));
        for (PetscInt d = 0; d < list->dim; d++) x[offset + d] = list->coords[middle[i] * list->dim + d];
      }
    }
  }
  PetscCall(VecRestoreArray(curves->positions, &x));
  PetscFunctionReturn(PETSC_SUCCESS);
}
