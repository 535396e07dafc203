/* solvabilityreport.c -- the solvability report, for the terminal and for the summary. */
#include "base/compat.h"
#include "base/json.h"
#include "base/warning.h"
#include "checks/roundness.h"
#include "checks/solvabilityreport.h"

/* Bodies that move together, body by body; where one is of several pieces, piece by piece. */
static void SolvabilityReportAddMotion_Private(VI vi, const SceneMotion *motion, cJSON *object)
{
  const PetscInt dim = vi->level->dim;

  for (PetscInt i = 0; i < motion->num; i++) {
    const BodyMotion *moves = &motion->bodies[i];
    cJSON            *body  = cJSON_AddObjectToObject(object, moves->name);

    if (!moves->whole) {
      cJSON_AddStringToObject(body, "body", vi->scene->bodies[moves->body].name);
      JSONAddInt(body, "piece", moves->piece);
    }

    JSONAddReals(body, "translation", dim, moves->translation);
    if (dim == 2)
      JSONAddReal(body, "rotation", moves->rotation[2]);
    else
      JSONAddReals(body, "rotation", dim, moves->rotation);
    JSONAddReals(body, "centre", dim, moves->centre);
    JSONAddReal(body, "work", moves->work);
  }
}

void SolvabilityReportAdd(VI vi, Solvability s, cJSON *root)
{
  static const char *const verdicts[] = {"solvable", "free_motion", "marginal", "no_solution"};
  cJSON                   *object     = cJSON_AddObjectToObject(root, "solvability"), *motions;

  cJSON_AddStringToObject(object, "verdict", verdicts[s ? s->status : SOLVABLE]);
  cJSON_AddBoolToObject(object, "on_this_mesh", s && s->coarse);
  if (s && s->motion.num) {
    SolvabilityReportAddMotion_Private(vi, &s->motion, cJSON_AddObjectToObject(object, "motion"));
    JSONAddReal(object, "work", s->motion.work);
    cJSON_AddStringToObject(object, "sentence", s->motion.sentence);
  } else {
    cJSON_AddNullToObject(object, "motion");
    cJSON_AddNullToObject(object, "work");
    cJSON_AddNullToObject(object, "sentence");
  }
  motions = cJSON_AddArrayToObject(object, "free_motions");
  for (PetscInt i = 0; s && i < s->num_free; i++) {
    cJSON *one = cJSON_CreateObject();

    SolvabilityReportAddMotion_Private(vi, &s->free[i], one);
    cJSON_AddItemToArray(motions, one);
  }
}

PetscErrorCode SolvabilityReportPrint(VI vi, Solvability s)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; s && i < s->num_free; i++)
    PetscCall(PetscPrintf(vi->level->comm, "  free motion: %s\n", s->free[i].sentence));
  if (s && s->num_free)
    PetscCall(PetscPrintf(vi->level->comm, "    the displacement is the one of least mean square\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityReportRefuse(VI vi, Solvability s)
{
  PetscFunctionBeginUser;
  if (s && s->status == SOLVABLE_NOT) {
    PetscCall(PetscFPrintf(
        vi->level->comm, PETSC_STDERR, "mortise: no solution%s: %s: the loads do %+.6g of work %s per %s and %s%s\n",
        s->coarse ? " on this mesh" : "", s->motion.sentence, (double)s->motion.work,
        s->motion.num > 1 ? "together" : "on it", s->motion.turns ? "radian" : "unit of length",
        s->slides ? "friction is too small to resist" : "nothing resists",
        s->coarse ? "; contact nodes end before the bodies do: refine, or align facets with the end of the partner"
                  : ""));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Motions that cost nothing: positions are one choice of many. */
static PetscErrorCode SolvabilityReportWarnFree_Private(Solvability s)
{
  const Warning about    = {.code   = "free_motion",
                            .advice = "support the body, or read nothing from displacements along this motion"};
  char          more[96] = "";

  PetscFunctionBeginUser;
  if (!s->num_free) PetscFunctionReturn(PETSC_SUCCESS);
  if (s->num_free > 1)
    PetscCall(PetscSNPrintf(more, sizeof(more), ", and %" PetscInt_FMT " more motions", s->num_free - 1));
  PetscCall(WarningAdd(&about,
                       "the position is not unique, that of least mean square displacement is given: %s%s at no cost",
                       s->free[0].sentence, more));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityReportWarn(VI vi, Solvability s)
{
  const char *then = "it is free to do so";
  PetscBool   round;

  PetscFunctionBeginUser;
  if (s) PetscCall(SolvabilityReportWarnFree_Private(s));
  if (!s || s->status != SOLVABLE_MARGINAL) PetscFunctionReturn(PETSC_SUCCESS);
  if (s->slides) {
    PetscCall(WarningAdd(&(Warning){.code = "marginal"}, "the loads are at the limit of what friction can hold: %s",
                         s->motion.sentence));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(RoundnessCarriesLoads(vi, s, &round));
  if (round) then = "its support is curved, and it can roll freely";
  if (s->motion.turns && !round) then = "the pressure gathers at an edge and grows without bound on finer meshes";
  PetscCall(WarningAdd(&(Warning){.code = "marginal"}, "the loads are marginal: %s at no cost; %s", s->motion.sentence,
                       then));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SolvabilityReportView(VI vi, Solvability s)
{
  static const char *const verdicts[] = {
      "contact can balance the loads and resists all of them",
      "contact can balance the loads; some of them stay free",
      "contact can balance the loads, but they are marginal",
      "contact cannot balance the loads",
  };

  PetscFunctionBeginUser;
  if (!s) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(PetscPrintf(vi->level->comm, "  rigid motions that supports leave: %" PetscInt_FMT "; %s\n", s->m,
                        verdicts[s->status]));
  PetscFunctionReturn(PETSC_SUCCESS);
}
