/* reachcheck.c -- the search radius check.

   A pair searches its partner within its reach. The reach is given, or chosen from meshes and given
   displacements. The displacements by loads are known only after the solution. If the sides of a pair have
   moved by no more than the reach together, no contact was missed. Otherwise an inequality is made whose
   reach is the distance that they moved. In its rows, the displacements must give no overlap at nodes that
   had no multiplier. */
#include "base/compat.h"
#include "base/warning.h"
#include "level/ghosted.h"
#include "study/reachcheck.h"

/* Largest overlap without missed contact, as a part of the motion; that of the certificate for rows of the
   inequality. */
static const PetscReal OVERLAP = 1e-6;

/* max |u| on a side, of this rank. */
static PetscErrorCode ReachCheckSideMotion_Private(Scene scene, Level *level, const SceneSide *side,
                                                   const PetscScalar u[], PetscReal *motion)
{
  const PetscInt dim = level->dim;
  Facets         facets;

  PetscFunctionBeginUser;
  *motion = 0;
  if (side->body < 0) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(LevelGetFacets(level, scene, side->body, side->side, &facets));
  for (PetscInt f = 0; f < facets.num; f++) {
    for (PetscInt i = 0; i < ElementNumNodes(facets.type[f]); i++) {
      const PetscInt node   = facets.nodes[f * ELEMENT_MAX_FACET_NODES + i];
      PetscReal      square = 0;

      for (PetscInt k = 0; k < dim; k++) square += PetscSqr(PetscRealPart(u[node * dim + k]));
      *motion = PetscMax(*motion, PetscSqrtReal(square));
    }
  }
  PetscCall(FacetsDestroy(&facets));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The sum of the largest displacements of both sides of each pair, 0 for tied pairs. Collective.
   [out] motion - [num_pairs] */
static PetscErrorCode ReachCheckGetMotions_Private(Run run, PetscReal motion[])
{
  const VI           vi = run->vi;
  const PetscScalar *values;
  PetscReal         *sides;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(2 * vi->num_pairs, &sides));
  PetscCall(GhostedGetArrayRead(run->fields->u, &values));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    const ScenePair *spec = vi->pairs[p]->spec;

    if (spec->type == PAIR_TIED) continue;
    PetscCall(ReachCheckSideMotion_Private(run->scene, vi->level, &spec->nonmortar, values, &sides[2 * p]));
    PetscCall(ReachCheckSideMotion_Private(run->scene, vi->level, &spec->mortar, values, &sides[2 * p + 1]));
  }
  PetscCall(GhostedRestoreArrayRead(run->fields->u, &values));
  PetscCallMPI(
      MPI_Allreduce(MPI_IN_PLACE, sides, (PetscMPIInt)(2 * vi->num_pairs), MPIU_REAL, MPI_MAX, vi->level->comm));
  for (PetscInt p = 0; p < vi->num_pairs; p++) motion[p] = sides[2 * p] + sides[2 * p + 1];
  PetscCall(PetscFree(sides));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest overlap of each pair at nodes with a multiplier in the wider inequality alone. Collective.
   [out] overlap - [num_pairs] */
static PetscErrorCode ReachCheckGetOverlaps_Private(const Run run, const VI wide, PetscReal overlap[])
{
  const VI           vi = run->vi;
  const PetscScalar *excess;
  PetscBool         *known; /* [num_pairs][num_owned] */
  const PetscInt     num = vi->level->num_owned;
  Vec                e;

  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < vi->num_pairs; p++) overlap[p] = 0;
  if (!wide->B) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscCalloc1(vi->num_pairs * num, &known));
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    for (PetscInt k = 0; k < vi->pairs[p]->num; k++) known[p * num + vi->pairs[p]->nodes[k]] = PETSC_TRUE;
  }
  PetscCall(VecDuplicate(wide->G, &e));
  PetscCall(MatMult(wide->B, run->fields->u, e));
  PetscCall(VecAXPY(e, -1, wide->G));
  PetscCall(VecGetArrayRead(e, &excess));
  for (PetscInt r = 0; r < wide->num_rows; r++) {
    const PetscInt p = wide->row_pair[r];

    if (wide->pairs[p]->spec->type == PAIR_TIED || known[p * num + wide->pairs[p]->nodes[wide->row_node[r]]]) continue;
    overlap[p] = PetscMax(overlap[p], PetscRealPart(excess[r]) / wide->row_D[r]);
  }
  PetscCall(VecRestoreArrayRead(e, &excess));
  PetscCall(VecDestroy(&e));
  PetscCall(PetscFree(known));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, overlap, (PetscMPIInt)vi->num_pairs, MPIU_REAL, MPI_MAX, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Makes the certificate fail: a reach of the user has missed contact. */
static PetscErrorCode ReachCheckFail_Private(const ScenePair *spec, PetscReal overlap, PetscReal motion, Certificate *c)
{
  PetscFunctionBeginUser;
  if (!c->holds) PetscFunctionReturn(PETSC_SUCCESS);
  c->holds = PETSC_FALSE;
  PetscCall(PetscSNPrintf(c->failure, sizeof(c->failure),
                          "contact was missed: sides of %s overlap by %.3g where they were farther apart than "
                          "-%s_reach %.6g; omit it, or give at least %.3g",
                          spec->name, (double)overlap, spec->name, (double)spec->reach, (double)motion));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Searches with the motions as reaches. [in] motion - [num_pairs]; [out] again - of ReachCheckRun() */
static PetscErrorCode ReachCheckSearch_Private(Run run, const PetscReal motion[], PetscBool *again)
{
  ScenePair *specs = run->scene->pairs;
  PetscReal *given, *overlap;
  PetscBool  open;
  VI         wide;

  PetscFunctionBeginUser;
  PetscCall(PetscMalloc2(run->scene->num_pairs, &given, run->scene->num_pairs, &overlap));
  for (PetscInt p = 0; p < run->scene->num_pairs; p++) {
    given[p] = specs[p].reach;
    if (motion[p] > run->vi->pairs[p]->reach) specs[p].reach = motion[p];
  }
  WarningMute(); // this inequality is for the check alone
  PetscCall(VICreate(run->scene, run->mesh, &wide));
  WarningUnmute();
  PetscCall(ReachCheckGetOverlaps_Private(run, wide, overlap));
  *again = PETSC_FALSE;
  for (PetscInt p = 0; p < run->scene->num_pairs; p++) {
    const PetscBool missed = (PetscBool)(overlap[p] > OVERLAP * motion[p]);

    open = (PetscBool)(given[p] < 0 || specs[p].widened);
    if (!open || !missed) specs[p].reach = given[p];
    if (!open && missed) PetscCall(ReachCheckFail_Private(&specs[p], overlap[p], motion[p], &run->certificate));
    if (open && missed) *again = specs[p].widened = PETSC_TRUE;
  }
  PetscCall(VIDestroy(&wide));
  PetscCall(PetscFree2(given, overlap));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ReachCheckRun(Run run, PetscBool *again)
{
  PetscReal *motion;
  PetscBool  far = PETSC_FALSE;

  PetscFunctionBeginUser;
  *again = PETSC_FALSE;
  PetscCall(PetscMalloc1(run->vi->num_pairs, &motion));
  PetscCall(ReachCheckGetMotions_Private(run, motion));
  for (PetscInt p = 0; p < run->vi->num_pairs; p++) far = (PetscBool)(far || motion[p] > run->vi->pairs[p]->reach);
  if (far) PetscCall(ReachCheckSearch_Private(run, motion, again));
  PetscCall(PetscFree(motion));
  PetscFunctionReturn(PETSC_SUCCESS);
}
