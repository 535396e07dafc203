/* roles.c -- which side of a pair carries the multiplier.

   The softer body (behind the sides), else the finer mesh, else the smaller side (THEORY.md, section 9): a stiff
   nonmortar side would put a stiff skin on a soft mortar side in the condensed matrix. All of it is judged on the
   coarsest level, where it is cheapest. */
#include "room.h"
#include <mortise/compat.h>
#include <mortise/fault.h>
#include <string.h>

static const PetscReal StiffnessRatio = 3; /* of the contact moduli; below it the mesh decides */
static const PetscReal SameSize = 1e-6;    /* relative; sizes this near are equal, so that round-off decides nothing */

/* What speaks for one side as nonmortar. Sizes are lengths, of sides in space areas. */
typedef struct {
  PetscReal modulus, facet_size, size;
} SideMeasure;

/* The contact modulus of a body's material in the middle of a cell. */
static PetscErrorCode CellGetModulus_Private(Scene scene, const Level *level, PetscInt cell, PetscReal *modulus)
{
  const SceneBody *body      = &scene->bodies[level->cell_body[cell]];
  const PetscInt  *nodes     = &level->cell_nodes[level->cell_start[cell]];
  const PetscInt   num       = LevelNumVertices(level, cell);
  PetscReal        middle[3] = {0, 0, 0}, C[36], upper[21], young, poisson;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < num; ++i) {
    for (PetscInt d = 0; d < level->dim; ++d) middle[d] += level->coords[nodes[i] * level->dim + d] / num;
  }
  if (body->stiffness) {
    PetscCall(ExpressionEvaluate(body->stiffness, level->dim, middle, upper));
    MaterialAnisotropic(scene->model, upper, body->angle, C);
  } else {
    PetscCall(ExpressionEvaluate(body->young, level->dim, middle, &young));
    PetscCall(ExpressionEvaluate(body->poisson, level->dim, middle, &poisson));
    MaterialIsotropic(scene->model, young, poisson, C);
  }
  *modulus = MaterialContactModulus(MaterialNumStrains(scene->model), C);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Means over the facets of a side, and over the cells behind them. */
static PetscErrorCode SideGetMeasure_Private(Scene scene, Level *level, const SceneSide *side, SideMeasure *measure)
{
  const SceneBody *body   = &scene->bodies[side->body];
  PetscReal        sum[3] = {0, 0, 0}; /* of moduli, of sizes, of ones */
  Facets           facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, side->body, side->side, &facets));
  for (PetscInt f = 0; f < facets.num; ++f) {
    PetscReal modulus = 0;

    PetscCall(CellGetModulus_Private(scene, level, facets.cell[f], &modulus));
    sum[0] += modulus;
    sum[1] += FacetGetMeasure(level, &facets, f, NULL);
    sum[2] += 1;
  }
  PetscCall(FacetsDestroy(&facets));
  PetscCall(ExpressionCheck(level->comm, body->stiffness));
  PetscCall(ExpressionCheck(level->comm, body->young));
  PetscCall(ExpressionCheck(level->comm, body->poisson));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPIU_REAL, MPIU_SUM, level->comm));
  *measure = (SideMeasure){.modulus = sum[0] / sum[2], .facet_size = sum[1] / sum[2], .size = sum[1]};
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether the roles as they stand should be swapped. */
static PetscBool RolesSwap_Private(const SideMeasure *nonmortar, const SideMeasure *mortar)
{
  if (nonmortar->modulus > StiffnessRatio * mortar->modulus) return PETSC_TRUE;
  if (mortar->modulus > StiffnessRatio * nonmortar->modulus) return PETSC_FALSE;
  if (PetscAbsReal(nonmortar->facet_size - mortar->facet_size) > SameSize * mortar->facet_size) {
    return nonmortar->facet_size > mortar->facet_size ? PETSC_TRUE : PETSC_FALSE;
  }
  return nonmortar->size > (1 + SameSize) * mortar->size ? PETSC_TRUE : PETSC_FALSE;
}

/* Roles that were given are kept; if they slow the solver down the log says so. */
static PetscErrorCode PairChooseRoles_Private(Scene scene, Level *level, ScenePair *pair)
{
  SideMeasure nonmortar, mortar;

  PetscFunctionBeginUser;
  PetscCall(SideGetMeasure_Private(scene, level, &pair->nonmortar, &nonmortar));
  PetscCall(SideGetMeasure_Private(scene, level, &pair->mortar, &mortar));
  if (!pair->roles_open) {
    if (nonmortar.modulus > StiffnessRatio * mortar.modulus) {
      PetscCall(PetscInfo(level->dm,
                          "Pair %s: the nonmortar body is stiffer than the mortar body (contact moduli %g > %g * %g): "
                          "swapping the sides helps the solver\n",
                          pair->name, (double)nonmortar.modulus, (double)StiffnessRatio, (double)mortar.modulus));
    }
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  if (RolesSwap_Private(&nonmortar, &mortar)) {
    const SceneSide side = pair->nonmortar;

    pair->nonmortar = pair->mortar;
    pair->mortar    = side;
  }
  PetscCall(PetscInfo(
      level->dm, "Pair %s: nonmortar is %s:%s (contact moduli %g and %g, facets %g and %g, sides %g and %g as typed)\n",
      pair->name, scene->bodies[pair->nonmortar.body].name, pair->nonmortar.side, (double)nonmortar.modulus,
      (double)mortar.modulus, (double)nonmortar.facet_size, (double)mortar.facet_size, (double)nonmortar.size,
      (double)mortar.size));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Number of a side's facets on this rank. */
static PetscErrorCode SideCount_Private(Scene scene, Level *level, PetscInt body, const char side[], PetscInt *num)
{
  Facets facets;

  PetscFunctionBeginUser;
  PetscCall(LevelGetFacets(level, scene, body, side, &facets));
  *num = facets.num;
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Whether two sides have a facet in common on any rank: their union counts it once. */
static PetscErrorCode SidesShare_Private(Scene scene, Level *level, const SceneSide *a, const SceneSide *b,
                                         PetscBool *share)
{
  const size_t len = strlen(a->side) + strlen(b->side) + sizeof("+");
  PetscInt     num[3]; /* of a, of b, of both */
  char        *both;

  PetscFunctionBeginUser;
  *share = PETSC_FALSE;
  if (a->body != b->body) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscMalloc1(len, &both));
  PetscCall(PetscSNPrintf(both, len, "%s+%s", a->side, b->side));
  PetscCall(SideCount_Private(scene, level, a->body, a->side, &num[0]));
  PetscCall(SideCount_Private(scene, level, a->body, b->side, &num[1]));
  PetscCall(SideCount_Private(scene, level, a->body, both, &num[2]));
  PetscCall(PetscFree(both));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, num, 3, MPIU_INT, MPI_SUM, level->comm));
  *share = num[2] < num[0] + num[1] ? PETSC_TRUE : PETSC_FALSE;
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A side may meet several others, each in a pair of its own, but no other twice, and never itself. */
static PetscErrorCode PairCheckRoles_Private(Scene scene, Level *level, PetscInt p)
{
  const ScenePair *pair = &scene->pairs[p];
  const char *nonmortar = scene->bodies[pair->nonmortar.body].name, *mortar = scene->bodies[pair->mortar.body].name;
  PetscBool   share;

  PetscFunctionBeginUser;
  PetscCall(SidesShare_Private(scene, level, &pair->nonmortar, &pair->mortar, &share));
  if (share) {
    PetscCall(FaultRaise(level->comm,
                         "pair '%s': sides '%s' and '%s' of body '%s' share facets, which cannot touch themselves",
                         pair->name, pair->nonmortar.side, pair->mortar.side, mortar));
  }
  for (PetscInt q = 0; q < p; ++q) {
    const ScenePair *before = &scene->pairs[q];

    if (before->mortar.body < 0) continue; // obstacles are all different
    PetscCall(SidesShare_Private(scene, level, &pair->nonmortar, &before->nonmortar, &share));
    if (share) PetscCall(SidesShare_Private(scene, level, &pair->mortar, &before->mortar, &share));
    if (share) {
      PetscCall(FaultRaise(level->comm,
                           "pairs '%s' and '%s' join facets of %s:%s to the same facets of %s:%s: leave one out",
                           before->name, pair->name, nonmortar, pair->nonmortar.side, mortar, pair->mortar.side));
    }
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode MeshChooseRoles(Mesh mesh)
{
  Scene  scene = mesh->scene;
  Level *level = &mesh->levels[0];

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < scene->num_pairs; ++p) {
    if (scene->pairs[p].mortar.body < 0) continue; // an obstacle
    PetscCall(PairChooseRoles_Private(scene, level, &scene->pairs[p]));
    PetscCall(PairCheckRoles_Private(scene, level, p));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}
