/* nodebases.c -- see the header. */
#include "base/compat.h"
#include "kernel/frame.h"
#include "kernel/vector.h"
#include "problem/nodebases.h"
#include "problem/vi.h"

/* A unit vector is along an axis, or two are parallel, to this. */
static const PetscReal PARALLEL = 1e-12;

/* F^-1 of a 2 x 2 or 3 x 3 matrix by cofactors. [in] F - [dim][dim]; [out] Finv - [dim][dim] */
static void NodeBasesInvertFrame_Private(PetscInt dim, const PetscReal F[], PetscReal Finv[])
{
  if (dim == 2) {
    const PetscReal det = F[0] * F[3] - F[1] * F[2];
    Finv[0]             = F[3] / det;
    Finv[1]             = -F[1] / det;
    Finv[2]             = -F[2] / det;
    Finv[3]             = F[0] / det;
    return;
  }
  for (PetscInt i = 0; i < 3; i++) {
    const PetscInt i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (PetscInt j = 0; j < 3; j++) {
      const PetscInt j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      Finv[j * 3 + i] = F[i1 * 3 + j1] * F[i2 * 3 + j2] - F[i1 * 3 + j2] * F[i2 * 3 + j1];
    }
  }
  const PetscReal det = F[0] * Finv[0] + F[1] * Finv[3] + F[2] * Finv[6];
  for (PetscInt i = 0; i < 9; i++) Finv[i] /= det;
}

/* The axis that a unit vector lies along, or -1. */
static PetscInt NodeBasesFindAxis_Private(PetscInt dim, const PetscReal d[])
{
  for (PetscInt k = 0; k < dim; k++) {
    if (PetscAbsReal(d[k]) > 1 - PARALLEL) return k;
  }
  return -1;
}

/* Whether some held direction of a node is not an axis. */
static PetscBool NodeBasesIsObliquelyFixed_Private(const Support *held, PetscInt node)
{
  const PetscInt dim = held->dim;

  for (PetscInt j = 0; j < held->count[node]; j++) {
    if (NodeBasesFindAxis_Private(dim, &held->directions[(node * dim + j) * dim]) < 0) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Marks special nodes in of_node (0 special, -1 ordinary) and lists them. */
static PetscErrorCode NodeBasesListNodes_Private(VI vi, NodeBases *bases)
{
  const Level *level = vi->level;
  PetscInt     num   = 0;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc1(level->num_owned, &bases->of_node));
  for (PetscInt i = 0; i < level->num_owned; i++)
    bases->of_node[i] = NodeBasesIsObliquelyFixed_Private(&vi->support, i) ? 0 : -1;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; k < vi->pairs[p]->num; k++) bases->of_node[vi->pairs[p]->nodes[k]] = 0;
  }
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (bases->of_node[i] == 0) bases->of_node[i] = num++;
  }
  bases->num = num;
  PetscCall(PetscMalloc3(num, &bases->node, num * level->dim * level->dim, &bases->F, num * level->dim * level->dim,
                         &bases->Finv));
  for (PetscInt i = 0; i < level->num_owned; i++) {
    if (bases->of_node[i] >= 0) bases->node[bases->of_node[i]] = i;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether a support fixes a node along a tangent: the node cannot slide, or needs no tie there. The support
   takes the tangential force. */
static PetscBool NodeBasesIsHeld_Private(const Support *held, PetscInt node, const PetscReal tangent[])
{
  const PetscInt dim = held->dim;

  for (PetscInt j = 0; j < held->count[node]; j++) {
    PetscReal dot = 0;

    for (PetscInt k = 0; k < dim; k++) dot += held->directions[(node * dim + j) * dim + k] * tangent[k];
    if (PetscAbsReal(dot) > 1 - PARALLEL) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Enters one node of a pair: a row of B and of F per constrained direction.
   [in,out] used - rows of F already taken by constraints [bases->num] */
static void NodeBasesAddNode_Private(VI vi, NodeBases *bases, PetscInt p, PetscInt k, PetscInt used[], PetscInt *row)
{
  const Pair      pair = vi->pairs[p];
  const PetscInt  dim = vi->level->dim, node = pair->nodes[k], s = bases->of_node[node];
  const PetscInt  num    = pair->spec->type == PAIR_TIED || ScenePairHasFriction(pair->spec) ? dim : 1;
  PetscReal      *F      = &bases->F[s * dim * dim];
  const PetscReal weight = pair->D[k] * vi->scene->thickness;

  if (used[s] == 0) {
    for (PetscInt i = 0; i < dim * dim; i++) F[i] = pair->frame[k * dim * dim + i];
  } else { // a second constraint takes the place of the first tangent
    for (PetscInt i = 0; i < dim; i++) F[used[s] * dim + i] = pair->normal[k * dim + i];
  }
  for (PetscInt i = 0; i < num; i++) {
    const PetscInt unknown = used[s]++;

    if (i && NodeBasesIsHeld_Private(&vi->support, node, &F[unknown * dim])) continue;
    vi->row_pair[*row]      = p;
    vi->row_node[*row]      = k;
    vi->row_direction[*row] = i;
    vi->row_dof[*row]       = dim * (vi->level->node_begin + node) + unknown;
    vi->row_D[(*row)++]     = weight;
  }
}

/* The last direction of a node in 3D with two constraints: across both normals. */
static void NodeBasesCompleteFrame_Private(PetscInt dim, PetscInt used, PetscReal F[])
{
  if (dim < 3 || used != 2) return;
  VectorCross(F, &F[3], &F[6]);
  FrameNormalize(3, &F[6]);
}

PetscErrorCode NodeBasesCreate(VI vi, NodeBases *bases)
{
  const PetscInt dim = vi->level->dim;
  PetscInt      *used, row = 0, most = 0;

  PetscFunctionBeginUser;
  PetscCall(NodeBasesListNodes_Private(vi, bases));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const ScenePair *spec = vi->pairs[p]->spec;

    most += vi->pairs[p]->num * (spec->type == PAIR_TIED || ScenePairHasFriction(spec) ? dim : 1);
  }
  PetscCall(PetscMalloc5(most, &vi->row_pair, most, &vi->row_node, most, &vi->row_direction, most, &vi->row_dof, most,
                         &vi->row_D));
  PetscCall(PetscCalloc1(bases->num, &used));
  for (PetscInt s = 0; s < bases->num; s++) { // oblique supports; pairs overwrite theirs
    PetscCall(PetscArraycpy(&bases->F[s * dim * dim], &vi->support.directions[bases->node[s] * dim * dim], dim * dim));
  }
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; k < vi->pairs[p]->num; k++) NodeBasesAddNode_Private(vi, bases, p, k, used, &row);
  }
  vi->num_rows = row;
  for (PetscInt s = 0; s < bases->num; s++) {
    NodeBasesCompleteFrame_Private(dim, used[s], &bases->F[s * dim * dim]);
    NodeBasesInvertFrame_Private(dim, &bases->F[s * dim * dim], &bases->Finv[s * dim * dim]);
  }
  PetscCall(PetscFree(used));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode NodeBasesDestroy(NodeBases *bases)
{
  PetscFunctionBeginUser;
  PetscCall(PetscFree(bases->of_node));
  PetscCall(PetscFree3(bases->node, bases->F, bases->Finv));
  PetscFunctionReturn(PETSC_SUCCESS);
}
