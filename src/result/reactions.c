/* reactions.c -- reactions of nodes, summed by side.

   A node where a clamped side meets a plane of symmetry has one force, and two sides that hold it. Given to
   one of them, the sums are of first order in the size of the cells there. Tractions of the recovered stress
   say how to split it. */
#include "base/compat.h"
#include "kernel/vector.h"
#include "level/ghosted.h"
#include "result/cellstress.h"
#include "result/reactions.h"

enum { F = ELEMENT_MAX_FACET_NODES };

/* What is split, and how. */
typedef struct {
  Fields     fields;
  PetscInt  *start;    /* index of each body's first boundary [num_bodies + 1] */
  PetscInt  *first;    /* index of each shared node's first part [num_shared + 1] */
  PetscReal *expected; /* int phi_a s* n [first[num_shared]][dim] */
  PetscReal *rests;    /* what of the force they are not [first[num_shared]][dim] */
} Reactions;

/* Adds int phi_a s* n over a facet. [in,out] sums - at local nodes [num_nodes][dim] */
static void ReactionsAddFacet_Private(const Level *level, const Facets *facets, PetscInt f,
                                      const NodalStressArrays *recovered, PetscScalar sums[])
{
  const ElementType type  = facets->type[f];
  const PetscInt   *nodes = &facets->nodes[f * F], n = ElementNumNodes(type), dim = level->dim;
  const PetscInt    material = level->cell_material[facets->cell[f]];
  PetscReal         X[3 * F], xi[2 * ELEMENT_MAX_POINTS], weight[ELEMENT_MAX_POINTS], x[3], phi[ELEMENT_MAX_NODES];
  const PetscInt    num = QuadratureRule(type, 2 * ElementOrder(type) + 1, xi, weight);

  VectorGather(dim, n, nodes, level->coords, X);
  for (PetscInt q = 0; q < num; q++) {
    PetscScalar stress[CELL_STRESSES] = {0};
    PetscReal   normal[3], traction[3];

    weight[q] *= ElementSurface(type, X, &xi[q * (dim - 1)], x, phi, normal);
    weight[q] *= SceneMeasure(level->scene, x);
    for (PetscInt i = 0; i < n * CELL_STRESSES; i++)
      stress[i % CELL_STRESSES] +=
          phi[i / CELL_STRESSES] * NodalStressAt(recovered, nodes[i / CELL_STRESSES], material)[i % CELL_STRESSES];
    CellStressTraction(dim, stress, normal, traction);
    for (PetscInt i = 0; i < n * dim; i++)
      sums[nodes[i / dim] * dim + i % dim] += weight[q] * phi[i / dim] * traction[i % dim];
  }
}

/* What is expected of one boundary at shared nodes. Collective. */
static PetscErrorCode ReactionsExpect_Private(Reactions *reactions, PetscInt body, PetscInt boundary)
{
  const Fields      fields  = reactions->fields;
  Level            *level   = fields->vi->level;
  const Support    *support = &fields->vi->support;
  NodalStressArrays recovered;
  Facets            facets;
  Vec               v;
  PetscScalar      *sums;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, level->scene, body, level->scene->bodies[body].boundaries[boundary].side, &facets));
  PetscCall(LevelCreateVec(level, level->dim, &v));
  PetscCall(GhostedGetArray(v, &sums));
  PetscCall(NodalStressGetArrays(&fields->stress, &recovered));
  for (PetscInt f = 0; f < facets.num; f++) ReactionsAddFacet_Private(level, &facets, f, &recovered, sums);
  PetscCall(NodalStressRestoreArrays(&fields->stress, &recovered));
  PetscCall(GhostedRestoreArray(v, &sums));
  PetscCall(LevelShareVec(v, ADD_VALUES));
  PetscCall(LevelConformForces(level, level->dim, v));
  PetscCall(VecGetArray(v, &sums));
  for (PetscInt s = 0; s < support->num_shared; s++) {
    const SharedNode *shared = &support->shared[s];

    if (shared->node >= level->num_owned || level->node_body[shared->node] != body) continue;
    for (PetscInt i = 0; i < shared->num; i++) {
      if (shared->side[i].boundary == boundary)
        PetscCall(PetscArraycpy(&reactions->expected[(reactions->first[s] + i) * level->dim],
                                &sums[shared->node * level->dim], level->dim));
    }
  }
  PetscCall(VecRestoreArray(v, &sums));
  PetscCall(VecDestroy(&v));
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Where two boundaries fix the same direction of a node. Collective. */
static PetscErrorCode ReactionsExpectAll_Private(Reactions *reactions)
{
  const Scene    scene   = reactions->fields->vi->scene;
  const Level   *level   = reactions->fields->vi->level;
  const Support *support = &reactions->fields->vi->support;
  PetscInt      *needed, num = 0; // by boundary

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(support->num_shared + 1, &reactions->first));
  for (PetscInt s = 0; s < support->num_shared; s++) {
    reactions->first[s] = num;
    num += support->shared[s].num;
  }
  reactions->first[support->num_shared] = num;
  PetscCall(PetscCalloc2(num * level->dim, &reactions->expected, num * level->dim, &reactions->rests));
  PetscCall(PetscCalloc1(reactions->start[scene->num_bodies] + 1, &needed));
  for (PetscInt s = 0; s < support->num_shared; s++) {
    const SharedNode *shared = &support->shared[s];

    for (PetscInt i = 0; i < shared->num && shared->ambiguous; i++)
      if (shared->side[i].boundary >= 0)
        needed[reactions->start[level->node_body[shared->node]] + shared->side[i].boundary] = 1;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, needed, (PetscMPIInt)reactions->start[scene->num_bodies], MPIU_INT, MPI_MAX,
                             scene->comm));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    for (PetscInt i = 0; i < scene->bodies[b].num_boundaries; i++)
      if (needed[reactions->start[b] + i]) PetscCall(ReactionsExpect_Private(reactions, b, i));
  }
  PetscCall(PetscFree(needed));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Splits the force of a shared node. [in,out] sums, rests - of the body's boundaries [num_boundaries][dim] */
static void ReactionsAddShared_Private(const Reactions *reactions, PetscInt s, const PetscReal force[],
                                       PetscReal sums[], PetscReal rests[])
{
  const Support    *support = &reactions->fields->vi->support;
  const SharedNode *shared  = &support->shared[s];
  PetscReal        *parts   = &reactions->expected[reactions->first[s] * support->dim];
  PetscReal        *left    = &reactions->rests[reactions->first[s] * support->dim];

  SupportSplitForce(support, shared, force, parts, left);
  for (PetscInt i = 0; i < shared->num; i++) {
    if (shared->side[i].boundary < 0) continue;
    for (PetscInt k = 0; k < support->dim; k++) {
      sums[shared->side[i].boundary * support->dim + k] += parts[i * support->dim + k];
      if (shared->ambiguous)
        rests[shared->side[i].boundary * support->dim + k] += PetscAbsReal(left[i * support->dim + k]);
    }
  }
}

/* Sums of this rank. [in,out] sums, rests - of all bodies' boundaries [dim] */
static PetscErrorCode ReactionsSum_Private(const Reactions *reactions, Vec nodal, PetscReal sums[], PetscReal rests[])
{
  const Level     *level   = reactions->fields->vi->level;
  const Support   *support = &reactions->fields->vi->support;
  const PetscInt   dim     = level->dim;
  const PetscReal *values;
  PetscInt         s = 0;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(nodal, &values));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    const PetscInt first = reactions->start[level->node_body[a]] * dim;

    while (s < support->num_shared && support->shared[s].node < a) s++;
    if (support->side[a] < 0) continue;
    if (s < support->num_shared && support->shared[s].node == a) {
      ReactionsAddShared_Private(reactions, s, &values[a * dim], &sums[first], &rests[first]);
      continue;
    }
    for (PetscInt k = 0; k < dim; k++) sums[first + support->side[a] * dim + k] += values[a * dim + k];
  }
  PetscCall(VecRestoreArrayRead(nodal, &values));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ReactionsCreate(Scene scene, Fields fields, Vec nodal, PetscReal **sums, PetscReal **rests)
{
  Reactions  reactions = {.fields = fields};
  PetscInt   num       = 0, size;
  PetscReal *both;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(scene->num_bodies + 1, &reactions.start));
  for (PetscInt b = 0; b < scene->num_bodies; b++) {
    reactions.start[b] = num;
    num += scene->bodies[b].num_boundaries;
  }
  reactions.start[scene->num_bodies] = num;
  size                               = num * scene->dim;
  PetscCall(PetscCalloc1(2 * size, &both));
  for (PetscInt i = 0; i < 2 * size && !fields; i++) both[i] = NAN;
  if (fields) {
    PetscCall(ReactionsExpectAll_Private(&reactions));
    PetscCall(ReactionsSum_Private(&reactions, nodal, both, &both[size]));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, both, (PetscMPIInt)(2 * size), MPIU_REAL, MPI_SUM, scene->comm));
    PetscCall(PetscFree2(reactions.expected, reactions.rests));
    PetscCall(PetscFree(reactions.first));
  }
  PetscCall(PetscFree(reactions.start));
  PetscCall(PetscMalloc1(size + 1, sums));
  PetscCall(PetscArraycpy(*sums, both, size));
  if (rests) {
    PetscCall(PetscMalloc1(size + 1, rests));
    PetscCall(PetscArraycpy(*rests, &both[size], size));
  }
  PetscCall(PetscFree(both));
  PetscFunctionReturn(PETSC_SUCCESS);
}
