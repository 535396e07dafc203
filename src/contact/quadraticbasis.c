/* quadraticbasis.c -- the quadratic basis transformation, in which the rows of a pair are written.

   At a node e behind the vertices v of a facet, u_e = d u~_e + sum_v w_v u~_v, and u_v = u~_v: hence u~_e =
   (u_e - sum_v w_v u_v) / d. The weights depend on the edge (or the quad) alone, so they are the same for
   neighbouring facets. */
#include "base/compat.h"
#include "kernel/dual.h"
#include "contact/mortarintegrals.h"
#include "contact/quadraticbasis.h"

/* d, and w of the vertices; returns whether u~_e differs from u_e.
   [in] node - behind the vertices; [out] w - [vertices] */
static PetscBool QuadraticBasisWeights_Private(ElementType type, ElementType carrier, PetscInt node, PetscReal *d,
                                               PetscReal w[])
{
  const PetscInt  num_vertices = ElementNumNodes(ElementLinear(type));
  const PetscReal share        = DualShare(carrier);

  *d = 1 - 2 * share;
  if (carrier != type) {
    ElementShape(carrier, ElementNode(type, node), w, NULL);
    return PETSC_TRUE;
  }
  if (share == 0) return PETSC_FALSE;
  for (PetscInt v = 0; v < num_vertices; v++) w[v] = 0;
  for (PetscInt k = 0; k < 2; k++) w[ElementEdgeNodes(type, node - num_vertices)[k]] = share;
  return PETSC_TRUE;
}

/* Enters S - I and S^-1 - I of one facet. */
static PetscErrorCode QuadraticBasisAddFacet_Private(const Level *level, const Facets *facets, PetscInt f,
                                                     ElementType carrier, Mat to_nodal, Mat from_nodal)
{
  const ElementType type         = facets->type[f];
  const PetscInt    num_vertices = ElementNumNodes(ElementLinear(type));
  PetscInt          nodes[ELEMENT_MAX_FACET_NODES];
  PetscReal         d, w[ELEMENT_MAX_NODES];

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < ElementNumNodes(type); i++)
    nodes[i] = level->node_global[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];
  for (PetscInt e = num_vertices; e < ElementNumNodes(type); e++) {
    if (!QuadraticBasisWeights_Private(type, carrier, e, &d, w)) continue;
    for (PetscInt v = 0; v < num_vertices; v++) {
      if (w[v] == 0) continue;
      PetscCall(MatSetValue(to_nodal, nodes[e], nodes[v], w[v], INSERT_VALUES));
      PetscCall(MatSetValue(from_nodal, nodes[e], nodes[v], -w[v] / d, INSERT_VALUES));
    }
    if (d == 1) continue;
    PetscCall(MatSetValue(to_nodal, nodes[e], nodes[e], d - 1, INSERT_VALUES));
    PetscCall(MatSetValue(from_nodal, nodes[e], nodes[e], 1 / d - 1, INSERT_VALUES));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode QuadraticBasisCreate(Level *level, const Facets *facets, const ElementType carrier[], Mat *to_nodal,
                                    Mat *from_nodal)
{
  Mat      *mats[2] = {to_nodal, from_nodal};
  PetscBool any     = PETSC_FALSE;
  PetscInt *entries;

  PetscFunctionBeginUser;
  *to_nodal = *from_nodal = NULL;
  for (PetscInt f = 0; f < facets->num; f++)
    any = (PetscBool)(any || carrier[f] != facets->type[f] || DualShare(carrier[f]) > 0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPIU_BOOL, MPI_LOR, level->comm));
  if (!any) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(facets->num, &entries));
  for (PetscInt f = 0; f < facets->num; f++) entries[f] = ElementNumNodes(ElementLinear(facets->type[f])) + 1;
  for (PetscInt i = 0; i < 2; i++) PetscCall(MortarIntegralsCreateMat(level, facets, entries, 1, mats[i]));
  PetscCall(PetscFree(entries));
  for (PetscInt f = 0; f < facets->num; f++)
    PetscCall(QuadraticBasisAddFacet_Private(level, facets, f, carrier[f], *to_nodal, *from_nodal));
  for (PetscInt i = 0; i < 2; i++) {
    PetscCall(MatAssemblyBegin(*mats[i], MAT_FINAL_ASSEMBLY));
    PetscCall(MatAssemblyEnd(*mats[i], MAT_FINAL_ASSEMBLY));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
