/* carryingnodes.c -- nodes whose functions are not zero on a facet beside hanging nodes.

   A node hangs on an edge, of which the facet has one half. The number of nodes of this edge outside of the
   facet is that of nodes that hang on it: the change of basis is square. */
#include "base/compat.h"
#include <petscblaslapack.h>
#include "contact/carryingnodes.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* The slot of a node among those of a facet, or -1. */
static PetscInt SlotOf_Private(PetscInt num, const PetscInt nodes[], PetscInt node)
{
  for (PetscInt i = 0; i < num; i++)
    if (nodes[i] == node) return i;
  return -1;
}

/* Lets nodes outside of a facet take the slots of those that hang.
   [in] own - nodes of the facet; [out] nodes, S - see DualNodes */
static PetscErrorCode FacetReplaceNodes_Private(const Level *level, PetscInt num, const PetscInt own[],
                                                PetscInt nodes[], PetscReal S[])
{
  const Hanging *hanging = &level->hanging;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(S, num * num));
  for (PetscInt i = 0; i < num; i++) nodes[i] = LevelNodeHangs(level, own[i]) ? -1 : own[i];
  for (PetscInt i = 0; i < num; i++) {
    if (!LevelNodeHangs(level, own[i])) {
      S[i * num + i] = 1;
      continue;
    }
    for (PetscInt k = hanging->start[own[i]]; k < hanging->start[own[i] + 1]; k++) {
      PetscInt slot = SlotOf_Private(num, nodes, hanging->node[k]);

      if (slot < 0) slot = SlotOf_Private(num, nodes, -1);
      PetscCheck(slot >= 0, PETSC_COMM_SELF, PETSC_ERR_PLIB, "A facet has more functions than nodes");
      nodes[slot]       = hanging->node[k];
      S[i * num + slot] = hanging->weight[k];
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The functions reproduce reference coordinates: this determines where their nodes are. */
static PetscErrorCode DualNodesSet_Private(const Level *level, ElementType type, const PetscInt own[], PetscInt nodes[],
                                           DualNodes *functions)
{
  const PetscInt n = ElementNumNodes(type), dim = ElementDim(type);
  PetscReal      A[F * F], places[2 * F];
  PetscBLASInt   rows = (PetscBLASInt)n, columns = (PetscBLASInt)dim, pivots[F], info;

  PetscFunctionBeginUser;
  PetscCall(FacetReplaceNodes_Private(level, n, own, nodes, functions->S));
  for (PetscInt i = 0; i < n; i++) { // by columns
    for (PetscInt j = 0; j < n; j++) A[j * n + i] = functions->S[i * n + j];
    for (PetscInt k = 0; k < dim; k++) places[k * n + i] = ElementNode(type, i)[k];
  }
  PetscCallBLAS("LAPACKgesv", LAPACKgesv_(&rows, &columns, A, &rows, pivots, places, &rows, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_PLIB, "Functions of a facet are dependent");
  for (PetscInt i = 0; i < n; i++)
    for (PetscInt k = 0; k < 2; k++) functions->place[i][k] = k < dim ? places[k * n + i] : 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CarryingNodesCreate(const Level *level, const Facets *facets, CarryingNodes *carrying)
{
  PetscInt num = 0;

  PetscFunctionBeginUser;
  *carrying = (CarryingNodes){.facets = *facets};
  PetscCall(PetscMalloc2(facets->num * F, &carrying->facets.nodes, facets->num, &carrying->number));
  PetscCall(PetscArraycpy(carrying->facets.nodes, facets->nodes, facets->num * F));
  for (PetscInt f = 0; f < facets->num; f++) {
    carrying->number[f] = -1;
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++)
      if (LevelNodeHangs(level, facets->nodes[f * F + i])) carrying->number[f] = num;
    if (carrying->number[f] >= 0) num++;
  }
  carrying->num = num;
  PetscCall(PetscMalloc1(num, &carrying->functions));
  for (PetscInt f = 0; f < facets->num; f++) {
    if (carrying->number[f] < 0) continue;
    PetscCall(DualNodesSet_Private(level, facets->type[f], &facets->nodes[f * F], &carrying->facets.nodes[f * F],
                                   &carrying->functions[carrying->number[f]]));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CarryingNodesDestroy(CarryingNodes *carrying)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree2(carrying->facets.nodes, carrying->number));
  PetscCall(PetscFree(carrying->functions));
  PetscFunctionReturn(PETSC_SUCCESS);
}
