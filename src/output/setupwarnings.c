/* setupwarnings.c -- see the header. */
#include "base/compat.h"
#include "base/warning.h"
#include "kernel/vector.h"
#include "side/sidemeasure.h"
#include "output/numberwords.h"
#include "output/setupwarnings.h"

/* If moduli or body forces of two bodies in contact differ by this factor, their units probably differ. Steel
   on soft rubber: 2e5. Pa and MPa: 1e6; N/m^3 and N/mm^3: 1e9. */
static const PetscReal MIXED_UNITS = 1.01e5;
/* Coefficients of friction are below it: rubber reaches 2. Angles and percentages are above. */
static const PetscReal LARGEST_FRICTION = 3;
/* FAR: a floating body warns if it closes a gap wider than this multiple of its diagonal. CARRIED: unless a
   given displacement carries it. */
static const PetscReal FAR = 1, CARRIED = 2;

/* Warns if two positive numbers of the bodies of a pair differ by a large factor.
   [in] sizes - of nonmortar and mortar body */
static PetscErrorCode SetupWarningsCompare_Private(Scene scene, const ScenePair *spec, const char words[],
                                                   const char advice[], const PetscReal sizes[2])
{
  const PetscReal factor = PetscMax(sizes[0], sizes[1]) / PetscMin(sizes[0], sizes[1]);
  const Warning   mixed  = {.code = "mixed_units", .pair = spec->name, .advice = advice};

  PetscFunctionBeginUser;
  if (!(PetscMin(sizes[0], sizes[1]) > 0) || !(factor > MIXED_UNITS)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(WarningAdd(&mixed, "%s of %s and %s, the bodies of %s, differ by a factor of %.1e", words,
                       scene->bodies[spec->nonmortar.body].name, scene->bodies[spec->mortar.body].name, spec->name,
                       (double)factor));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Moduli and body forces of the bodies of a pair. Collective. */
static PetscErrorCode SetupWarningsCompareBodies_Private(VI vi, const ScenePair *spec)
{
  const Scene     scene   = vi->scene;
  const SceneSide sides[] = {spec->nonmortar, spec->mortar};
  PetscReal       moduli[2], forces[2] = {0, 0};

  PetscFunctionBeginUser;
  if (spec->mortar.body < 0 || spec->mortar.body == spec->nonmortar.body) PetscFunctionReturn(PETSC_SUCCESS);
  for (PetscInt i = 0; i < 2; i++) {
    const Expression force   = scene->bodies[sides[i].body].material.body_force;
    const PetscReal  zero[3] = {0, 0, 0};
    PetscReal        value[3];
    SideMeasure      measure;

    PetscCall(SideMeasureCompute(scene, vi->level, &sides[i], &measure));
    moduli[i] = measure.modulus;
    if (!force || !ExpressionIsConstant(force)) continue;
    PetscCall(ExpressionEvaluate(force, scene->dim, zero, value));
    forces[i] = VectorNorm(scene->dim, value);
  }
  PetscCall(SetupWarningsCompare_Private(scene, spec, "the moduli",
                                         "check that both have the same units; a rigid tool may be an obstacle; "
                                         "-warnings_accept mixed_units where the moduli are meant",
                                         moduli));
  PetscCall(
      SetupWarningsCompare_Private(scene, spec, "the body forces", "check that both have the same units", forces));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A coefficient of friction that is likely an angle or a percentage. */
static PetscErrorCode SetupWarningsCheckFriction_Private(const ScenePair *spec)
{
  const PetscReal zero[3] = {0, 0, 0};
  const Warning   large   = {.code   = "large_friction",
                             .pair   = spec->name,
                             .advice = "give the tangent of the angle of friction, or the hundredth of a percentage"};
  PetscReal       friction;

  PetscFunctionBeginUser;
  if (!spec->friction || !ExpressionIsConstant(spec->friction)) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(ExpressionEvaluate(spec->friction, 1, zero, &friction));
  if (friction > LARGEST_FRICTION)
    PetscCall(WarningAdd(&large, "%s %s is a coefficient larger than materials have", ExpressionOption(spec->friction),
                         ExpressionText(spec->friction)));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The constant gap or offset that an option gives for a pair of contact; 0 where there is none. */
static PetscErrorCode SetupWarningsGetGivenGap_Private(const ScenePair *spec, Expression *given, PetscReal *gap)
{
  const PetscReal zero[3] = {0, 0, 0};

  PetscFunctionBeginUser;
  *given = spec->gap_offset ? spec->gap_offset : spec->gap;
  *gap   = 0;
  if (*given && spec->type == PAIR_CONTACT && ExpressionIsConstant(*given))
    PetscCall(ExpressionEvaluate(*given, 1, zero, gap));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Constant gaps that a rigid motion of floating bodies changes to zero: they move bodies without strain.
   Collective. */
static PetscErrorCode SetupWarningsFindIdleGaps_Private(VI vi, Solvability s)
{
  PetscReal *gaps;
  PetscBool  any = PETSC_FALSE, idle = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscCalloc1(vi->num_pairs, &gaps));
  for (PetscInt p = 0; p < vi->num_pairs && s; p++) {
    Expression given;

    PetscCall(SetupWarningsGetGivenGap_Private(vi->pairs[p]->spec, &given, &gaps[p]));
    any = (PetscBool)(any || gaps[p] != 0);
  }
  if (any) PetscCall(SolvabilityTakesGaps(vi, s, gaps, &idle));
  for (PetscInt p = 0; p < vi->num_pairs && idle; p++) {
    const ScenePair *spec  = vi->pairs[p]->spec;
    const Warning    about = {
           .code = "idle_gap", .pair = spec->name, .advice = "check its sign, support the body, or omit the option"};
    Expression given;

    PetscCall(SetupWarningsGetGivenGap_Private(spec, &given, &gaps[p]));
    if (gaps[p] == 0) continue;
    PetscCall(WarningAdd(&about, "%s %s strains nothing: a body is free to move by it%s", ExpressionOption(given),
                         ExpressionText(given),
                         given == spec->gap ? ""
                         : gaps[p] > 0      ? ", and its mesh then overlaps that of its partner"
                                            : ", and its mesh then floats above that of its partner"));
  }
  PetscCall(PetscFree(gaps));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The largest gap of all pairs before any motion. Collective. */
static PetscErrorCode SetupWarningsGetWidestGap_Private(VI vi, PetscReal *widest)
{
  PetscFunctionBeginUser;
  *widest = 0;
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const Pair     pair = vi->pairs[vi->row_pair[r]];
    const PetscInt a    = vi->row_node[r];

    if (pair->spec->type == PAIR_CONTACT) *widest = PetscMax(*widest, pair->gap[a] / pair->share[a]);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, widest, 1, MPIU_REAL, MPIU_MAX, vi->level->comm));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Floating bodies that close a gap wider than they are. Collective. */
static PetscErrorCode SetupWarningsFindFarMotions_Private(VI vi, Fields fields)
{
  const RigidModes  *modes = &vi->rigid_modes;
  const PetscInt     num = modes->components.num, dim = vi->level->dim;
  const PetscScalar *u;
  PetscReal         *sums, widest; // of displacements, and the number of nodes [num][4]

  PetscFunctionBeginUser;
  PetscCall(SetupWarningsGetWidestGap_Private(vi, &widest));
  PetscCall(PetscCalloc1(4 * num, &sums));
  PetscCall(VecGetArrayRead(fields->u, &u));
  for (PetscInt a = 0; a < vi->level->num_owned; a++) {
    PetscReal *sum = &sums[4 * modes->components.of_node[a]];

    for (PetscInt k = 0; k < dim; k++) sum[k] += PetscRealPart(u[a * dim + k]);
    sum[3] += 1;
  }
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(4 * num), MPIU_REAL, MPI_SUM, vi->level->comm));
  for (PetscInt i = 0; i < num; i++) {
    const char     *name   = vi->scene->bodies[modes->components.body[i]].name;
    const PetscReal length = VectorNorm(dim, &sums[4 * i]) / sums[4 * i + 3], size = 2 * modes->frames[4 * i + 3];
    const Warning   about = {.code   = "far_motion",
                             .body   = name,
                             .advice = "check the positions and units of the bodies, and the signs of the loads"};
    char            by[128];

    if (!modes->loose[i] || PetscMin(length, widest) <= FAR * size || length <= CARRIED * vi->support.max_value)
      continue;
    for (PetscInt k = 0; k < dim; k++) sums[4 * i + k] /= sums[4 * i + 3];
    PetscCall(NumberWordsVectorBeside(dim, &sums[4 * i], length, by, sizeof(by)));
    PetscCall(WarningAdd(&about, "body %s moves by %s, %.3g times its own diagonal, before contact holds it", name, by,
                         (double)(length / size)));
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SetupWarningsAdd(VI vi, Solvability solvability, Fields fields)
{
  PetscFunctionBeginUser;
  for (PetscInt p = 0; p < vi->num_pairs; p++) {
    PetscCall(SetupWarningsCompareBodies_Private(vi, vi->pairs[p]->spec));
    PetscCall(SetupWarningsCheckFriction_Private(vi->pairs[p]->spec));
  }
  PetscCall(SetupWarningsFindIdleGaps_Private(vi, solvability));
  if (fields && solvability) PetscCall(SetupWarningsFindFarMotions_Private(vi, fields));
  PetscFunctionReturn(PETSC_SUCCESS);
}
