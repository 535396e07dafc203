/* bodymerge.c -- all bodies in one DMPlex, disconnected, on the first rank or by parts. Coincident nodes of
   two bodies stay two nodes. */
#include "base/compat.h"
#include "bodies/bodylist.h"
#include "bodies/bodymerge.h"
#include "bodies/curvedfile.h"
#include "bodies/plexlist.h"
#include "level/plexpoints.h"

/* The point that is a facet of a list: PETSc numbers facets of solids in an order of its own. */
static PetscErrorCode MergeGetFacetPoint_Private(const BodyList *list, const Numbering *numbering, PetscInt body,
                                                 PetscInt f, DM dm, PetscInt *point)
{
  const PetscInt    cell  = list->facet_cell[f];
  const ElementType type  = ElementLinear((ElementType)list->cell_type[cell]);
  const PetscInt    num   = ElementNumNodes(ElementFacetType(type));
  const PetscInt   *nodes = ElementFacetNodes(type, list->facet[f]);
  PetscInt          vertices[ELEMENT_MAX_FACET_NODES];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; i++)
    vertices[i] = numbering->first_vertex[body] + list->cell_nodes[cell * ELEMENT_MAX_NODES + nodes[i]];
  PetscCall(PointFindFacet(dm, numbering->point[body][cell], num, vertices, point));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* "material" on cells; "<body>:<side>" on facets, value 1. All ranks make the labels, the first one fills
   them; distribution and refinement carry them on. */
static PetscErrorCode MergeSetLabels_Private(Scene scene, const BodyList lists[], const SideNames names[],
                                             const Numbering *numbering, DM dm)
{
  DMLabel label;

  PetscFunctionBeginUser;
  PetscCall(DMCreateLabel(dm, "material"));
  PetscCall(DMGetLabel(dm, "material", &label));
  for (PetscInt b = 0; b < numbering->num_bodies; b++) {
    for (PetscInt c = 0; c < lists[b].num_cells; c++)
      PetscCall(DMLabelSetValue(label, numbering->point[b][c], lists[b].cell_material ? lists[b].cell_material[c] : b));
  }
  for (PetscInt b = 0; b < numbering->num_bodies; b++) {
    for (PetscInt s = 0; s < names[b].num; s++) {
      char text[PETSC_MAX_PATH_LEN];

      PetscCall(PetscSNPrintf(text, sizeof(text), "%s:%s", scene->bodies[b].name, names[b].name[s]));
      PetscCall(DMCreateLabel(dm, text));
      PetscCall(DMGetLabel(dm, text, &label));
      for (PetscInt f = 0; f < lists[b].num_facets; f++) {
        PetscInt point;

        if (lists[b].facet_side[f] != s) continue;
        PetscCall(MergeGetFacetPoint_Private(&lists[b], numbering, b, f, dm, &point));
        PetscCall(DMLabelSetValue(label, point, 1));
      }
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshMerge(Scene scene, const BodyList lists[], const SideNames names[], DM *dm, Curves *curves)
{
  Numbering numbering;

  PetscFunctionBeginUser;
  PetscCall(NumberingCreate(scene->num_bodies, lists, &numbering));
  PetscCall(PlexCreate(scene->comm, scene->dim, lists, &numbering, dm));
  PetscCall(CurvesCreate(*dm, lists, &numbering, curves));
  PetscCall(MergeSetLabels_Private(scene, lists, names, &numbering, *dm));
  PetscCall(NumberingDestroy(&numbering));
  PetscFunctionReturn(PETSC_SUCCESS);
}
