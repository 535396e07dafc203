/* search.c -- the mortar side on every rank, in a box tree.

   A contact side of a plane body has of the order of sqrt(N) facets: every rank holds the whole of the mortar side, and
   each nonmortar facet is served by the rank that holds it. */
#include <mortise/compat.h>
#include "surface.h"

void FacetCoordinates(const Level *level, const Facets *facets, PetscInt f, PetscReal X[])
{
  const PetscInt n = ElementNumNodes(facets->type[f]);

  for (PetscInt i = 0; i < n; i++) {
    const PetscReal *x = &level->coords[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i] * level->dim];
    for (PetscInt k = 0; k < level->dim; k++) X[i * level->dim + k] = x[k];
  }
}

/* A parabola leaves the box of its nodes a little, but never the triangle of its ends and the point in which its tangents
   there meet, 2 x_middle - (x_first + x_last) / 2. */
void FacetBox(PetscInt dim, ElementType type, const PetscReal X[], PetscReal box[])
{
  for (PetscInt k = 0; k < dim; k++) {
    box[k] = box[dim + k] = X[k];
    for (PetscInt i = 1; i < ElementNumNodes(type); i++) {
      PetscReal x = X[i * dim + k];
      if (type == ELEMENT_LINE3 && i == 2) x = 2 * x - 0.5 * (X[k] + X[dim + k]);
      box[k]       = PetscMin(box[k], x);
      box[dim + k] = PetscMax(box[dim + k], x);
    }
  }
}

PetscReal FacetSize(PetscInt dim, ElementType type, const PetscReal X[])
{
  const PetscInt num_vertices = ElementNumNodes(ElementLinear(type));
  PetscReal      size         = 0;

  for (PetscInt i = 0; i < num_vertices; i++) {
    PetscReal d2 = 0;
    for (PetscInt k = 0; k < dim; k++) d2 += PetscSqr(X[i * dim + k] - X[((i + 1) % num_vertices) * dim + k]);
    size = PetscMax(size, PetscSqrtReal(d2));
  }
  return size;
}

PetscErrorCode FacetsMaxSize(const Level *level, const Facets *facets, PetscReal *size)
{
  PetscReal X[3 * ELEMENT_MAX_FACET_NODES];

  PetscFunctionBeginUser;
  *size = 0;
  for (PetscInt f = 0; f < facets->num; f++) {
    FacetCoordinates(level, facets, f, X);
    *size = PetscMax(*size, FacetSize(level->dim, facets->type[f], X));
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, size, 1, MPIU_REAL, MPIU_MAX, level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* One facet as it travels between ranks. */
typedef struct {
  PetscInt  type, nodes[ELEMENT_MAX_FACET_NODES];
  PetscReal coords[3 * ELEMENT_MAX_FACET_NODES];
} FacetRecord;

/* Concatenates every rank's records in the order of ranks; *all is owned by the caller. */
static PetscErrorCode GatherRecords_Private(MPI_Comm comm, PetscInt num, const FacetRecord mine[], PetscInt *num_all,
                                            FacetRecord **all)
{
  const PetscMPIInt bytes = (PetscMPIInt)(num * (PetscInt)sizeof(FacetRecord));
  PetscMPIInt      *counts, *offsets, size;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc2(size, &counts, size + 1, &offsets));
  PetscCallMPI(MPI_Allgather(&bytes, 1, MPI_INT, counts, 1, MPI_INT, comm));
  offsets[0] = 0;
  for (PetscMPIInt r = 0; r < size; r++) offsets[r + 1] = offsets[r] + counts[r];
  *num_all = offsets[size] / (PetscMPIInt)sizeof(FacetRecord);
  PetscCall(PetscMalloc1(*num_all, all));
  PetscCallMPI(MPI_Allgatherv(mine, bytes, MPI_BYTE, *all, counts, offsets, MPI_BYTE, comm));
  PetscCall(PetscFree2(counts, offsets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Boxes around the facets, into a tree. */
static PetscErrorCode BuildTree_Private(PetscInt dim, MortarSurface *surface)
{
  PetscReal *boxes;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(2 * dim * surface->num, &boxes));
  for (PetscInt f = 0; f < surface->num; f++)
    FacetBox(dim, surface->type[f], &surface->coords[f * ELEMENT_MAX_FACET_NODES * dim], &boxes[2 * f * dim]);
  PetscCall(BoxTreeCreate(dim, surface->num, boxes, &surface->tree));
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarSurfaceCreate(Level *level, const Facets *facets, MortarSurface *surface)
{
  const PetscInt dim = level->dim;
  FacetRecord   *mine, *all;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(facets->num, &mine));
  for (PetscInt f = 0; f < facets->num; f++) {
    mine[f].type = facets->type[f];
    for (PetscInt i = 0; i < ElementNumNodes(facets->type[f]); i++) {
      mine[f].nodes[i] = level->node_global[facets->nodes[f * ELEMENT_MAX_FACET_NODES + i]];
    }
    FacetCoordinates(level, facets, f, mine[f].coords);
  }
  PetscCall(GatherRecords_Private(level->comm, facets->num, mine, &surface->num, &all));
  PetscCall(PetscFree(mine));
  PetscCall(PetscMalloc3(surface->num, &surface->type, surface->num * ELEMENT_MAX_FACET_NODES, &surface->nodes,
                         surface->num * ELEMENT_MAX_FACET_NODES * dim, &surface->coords));
  for (PetscInt f = 0; f < surface->num; f++) {
    surface->type[f] = (ElementType)all[f].type;
    PetscCall(PetscArraycpy(&surface->nodes[f * ELEMENT_MAX_FACET_NODES], all[f].nodes, ELEMENT_MAX_FACET_NODES));
    PetscCall(PetscArraycpy(&surface->coords[f * ELEMENT_MAX_FACET_NODES * dim], all[f].coords,
                            ELEMENT_MAX_FACET_NODES * dim));
  }
  PetscCall(PetscFree(all));
  PetscCall(BuildTree_Private(dim, surface));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MortarSurfaceDestroy(MortarSurface *surface)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree3(surface->type, surface->nodes, surface->coords));
  PetscCall(BoxTreeDestroy(&surface->tree));
  surface->num = 0;
  PetscFunctionReturn(PETSC_SUCCESS);
}
