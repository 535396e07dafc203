/* sidecorners.c -- where sides end, and the angles of bodies at their vertices. */
#include "result/sidecorners.h"
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include <math.h>

enum { F = ELEMENT_MAX_FACET_NODES };

/* The vector of SideCornersGetEnds() that counts as zero, relative to the length of edges. */
static const PetscReal CLOSED = 1e-6;

PetscErrorCode SideCornersGetEnds(Level *level, const Facets *facets, Vec *ways)
{
  const PetscInt dim = level->dim;
  PetscScalar   *way;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, dim, ways));
  PetscCall(GhostedGetArray(*ways, &way));
  for (PetscInt f = 0; f < facets->num; f++) {
    const PetscInt *nodes = &facets->nodes[f * F], num = ElementNumNodes(ElementLinear(facets->type[f]));

    for (PetscInt i = 0; i < num; i++) {
      const PetscInt next = nodes[(i + 1) % num], before = nodes[(i + num - 1) % num];

      if (dim == 2) way[nodes[i] * dim] += i ? 1 : -1;
      for (PetscInt k = 0; k < dim && dim == 3; k++)
        way[nodes[i] * dim + k] += level->coords[next * dim + k] - level->coords[before * dim + k];
    }
  }
  PetscCall(GhostedRestoreArray(*ways, &way));
  PetscCall(LevelShareVec(*ways, ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscBool SideCornersIsEnd(PetscInt dim, const PetscScalar way[], PetscReal size)
{
  PetscReal square = 0;

  for (PetscInt k = 0; k < dim; k++) square += PetscSqr(PetscRealPart(way[k]));
  return (PetscBool)(PetscSqrtReal(square) > CLOSED * (dim == 2 ? 1 : size));
}

/* Angle of a cell at a vertex, in space half its solid angle. The sum over the cells at a vertex of a
   straight edge is the angle of the edge. */
static PetscReal CornerAngle_Private(const Level *level, ElementType linear, const PetscInt nodes[], PetscInt corner)
{
  const PetscInt dim     = level->dim;
  PetscReal      e[3][3] = {{0}}, length[3], det, dot;
  PetscInt       num     = 0;

  for (PetscInt i = 0; i < ElementNumEdges(linear) && num < dim; i++) {
    const PetscInt *ends = ElementEdgeNodes(linear, i);

    if (ends[0] != corner && ends[1] != corner) continue;
    for (PetscInt k = 0; k < dim; k++)
      e[num][k] = level->coords[nodes[ends[0] + ends[1] - corner] * dim + k] - level->coords[nodes[corner] * dim + k];
    length[num] = VectorNorm(dim, e[num]);
    num++;
  }
  dot = VectorDot(dim, e[0], e[1]);
  if (dim == 2) return PetscAbsReal(atan2(VectorCrossPlane(e[0], e[1]), dot));
  det = VectorTriple(e[0], e[1], e[2]);
  return atan2(PetscAbsReal(det), length[0] * length[1] * length[2] + dot * length[2] +
                                      VectorDot(dim, e[0], e[2]) * length[1] + VectorDot(dim, e[1], e[2]) * length[0]);
}

PetscErrorCode SideCornersGetAngles(Level *level, PetscInt body, Vec *angles)
{
  PetscScalar *angle;

  PetscFunctionBeginUser;
  PetscCall(LevelCreateVec(level, 1, angles));
  PetscCall(GhostedGetArray(*angles, &angle));
  for (PetscInt c = 0; c < level->num_cells; c++) {
    const ElementType linear = ElementLinear((ElementType)level->cell_type[c]);
    const PetscInt   *nodes  = &level->cell_nodes[level->cell_start[c]];

    for (PetscInt i = 0; i < ElementNumNodes(linear) && level->cell_body[c] == body; i++)
      angle[nodes[i]] += CornerAngle_Private(level, linear, nodes, i);
  }
  PetscCall(GhostedRestoreArray(*angles, &angle));
  PetscCall(LevelShareVec(*angles, ADD_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}
