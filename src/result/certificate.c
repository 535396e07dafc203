/* certificate.c -- residuals of the uncondensed KKT system  K u + B'lambda = f,  B u <= G,  lambda >= 0.

   Every test is a violation over a size. A violation within the roundoff of its own sums means nothing,
   even if the size is small: a body that moves rigidly has no forces. Therefore roundoff / limit is added
   to the size: value = violation / (size + roundoff / limit), held to the limit. What this excuses is
   itself held to a limit. Forces of a small strain beside a large rigid motion have few digits, or none
   (eq. 11.1a).

   Balance. With r the residual, split into a free part and the supports' part -R,
       f + R + C_obstacle = K u + B'lambda_mesh + r_free.
   K u has neither resultant nor moment: rigid motions, with rotations, are its kernel. The contact forces
   between two meshes have no resultant: row sums of D and M agree. Their moment vanishes on flat or touching
   sides. On curved sides with a gap a discretisation error remains. A nodal normal is not the direction of
   the ray at every point (Puso & Laursen 2004 discuss the same). That part is known exactly, is reported, and
   is subtracted before the test. It depends on the mesh, not on the solution of the discrete problem. Ties
   transfer force and moment, across a gap as well (eq. 5.4): their moment stays in the test. Forces on a ring
   add up to one along its axis. Radial components and all moments are 0 by symmetry, and so are the tests of
   them. */
#include "kernel/vector.h"
#include "result/certificate.h"
#include "base/compat.h"

/* Tolerance of a test. A factorization leaves 1e-12. An iterative solver that stops at its default relative
   residual of 1e-8 must pass as well. Its right-hand side counts given displacements as forces, which may be
   tens of times the forces of the solution. */
static const PetscReal TOLERANCE = 1e-6;

/* The same where the solver stops at the discretisation error. The bound in the energy norm (eq. 14.7) then
   tells the error, and these tests detect only states without balance. */
static const PetscReal STOPPED_TOLERANCE = 5e-2;

/* A nodal force K u is known to this part of stiffness times displacement. Rigid motions of the tests, which
   have no forces, leave 0.4 to 3.2 units of roundoff. */
static const PetscReal NODE_ROUNDING = 4 * PETSC_MACHINE_EPSILON;

/* Three forces of a node count, each with this bound of roundoff or more: arms of ties had 1.4 of it. */
static const PetscReal REST = 16;
/* A motion by this many lengths of a body: beyond, roundoff is a strain of 1e-9. */
static const PetscReal LONG_MOTION = 1e6;

/* What is summed over nodes and rows of all ranks. */
enum {
  SUM_FREE, /* squares of forces over stiffness: residual, loads, inner, contact, roundoff */
  SUM_LOADS,
  SUM_INNER,
  SUM_CONTACT,
  SUM_ROUNDOFF,
  SUM_COMPLEMENTARITY,
  SUM_COMPLEMENTARITY_ROUNDOFF,
  SUM_WORK,
  SUM_WORK_ROUNDOFF,
  SUM_ENERGY, /* u.Ku */
  SUM_PULL,   /* contact forces that pull; all of them, with their roundoff over the tolerance */
  SUM_PRESS,
  SUM_WEIGHTLESS,                      /* rows */
  SUM_FORCE,                           /* resultant [3] */
  SUM_MOMENT     = SUM_FORCE + 3,      /* moment about the centre [3] */
  SUM_PAIRMOMENT = SUM_MOMENT + 3,     /* of forces between meshes in contact, not tied [3] */
  SUM_SIZES      = SUM_PAIRMOMENT + 3, /* of forces, of moments, and of the roundoff of both [4] */
  SUM_COUNT      = SUM_SIZES + 4
};
/* Largest of all ranks. */
enum { MAX_GAP, MAX_PRESSURE, MAX_COUNT };

/* The forces on the nodes; noise is the roundoff of contact forces: a soft side gets that of a stiff one. */
enum { LOADS, INNER, CONTACT, OBSTACLE, RESIDUAL, REACTION, NOISE, MESHES, FORCE_COUNT };

/* The violation of a test over its size. [in] limit - of the value */
static PetscReal CertificateRatio_Private(PetscReal violation, PetscReal size, PetscReal roundoff, PetscReal limit)
{
  return violation == 0.0 ? 0.0 : violation / (size + roundoff / limit);
}

/* The part of B'lambda with a rigid partner, or with another mesh that is in contact.
   [in] lambda - for work */
static PetscErrorCode CertificateDirectionPart_Private(Fields fields, PetscBool rigid, Vec lambda, Vec part)
{
  const VI   vi = fields->vi;
  PetscReal *l;

  PetscFunctionBeginUser;
  PetscCall(VecCopy(fields->lambda, lambda));
  PetscCall(VecGetArray(lambda, &l));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    const ScenePair *spec = vi->pairs[vi->row_pair[r]]->spec;

    if (spec->type == PAIR_TIED || rigid != (PetscBool)(spec->obstacle.kind != OBSTACLE_NONE)) l[r] = 0.0;
  }
  PetscCall(VecRestoreArray(lambda, &l));
  PetscCall(MatMultTranspose(vi->B, lambda, part));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* |B|' times the roundoff of lambda, which does not cancel where arms of ties (eq. 5.4) do.
   [in,out] noise - zero */
static PetscErrorCode CertificateNodeRounding_Private(Fields fields, Vec noise)
{
  PetscInt           begin, num;
  const PetscInt    *columns;
  const PetscScalar *values;

  PetscFunctionBeginUser;
  PetscCall(MatGetOwnershipRange(fields->vi->B, &begin, NULL));
  for (PetscInt r = 0; r < fields->vi->num_rows; r++) {
    PetscCall(MatGetRow(fields->vi->B, begin + r, &num, &columns, &values));
    for (PetscInt c = 0; c < num; c++)
      PetscCall(VecSetValue(noise, columns[c], PetscAbsScalar(values[c]) * fields->row_noise[r], ADD_VALUES));
    PetscCall(MatRestoreRow(fields->vi->B, begin + r, &num, &columns, &values));
  }
  PetscCall(VecAssemblyBegin(noise));
  PetscCall(VecAssemblyEnd(noise));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* inner = K u, contact = B'lambda, obstacle and meshes are parts of it, residual = f - inner - contact. */
static PetscErrorCode CertificateCreateForces_Private(Fields fields, Vec forces[])
{
  const VI vi = fields->vi;
  Vec      lambda;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < FORCE_COUNT; i++) {
    PetscCall(VecDuplicate(fields->u, &forces[i]));
    PetscCall(VecZeroEntries(forces[i]));
  }
  PetscCall(VecCopy(vi->f, forces[LOADS]));
  PetscCall(MatMult(vi->K, fields->u, forces[INNER]));
  PetscCall(VecWAXPY(forces[RESIDUAL], -1.0, forces[INNER], forces[LOADS]));
  if (!fields->lambda) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(MatMultTranspose(vi->B, fields->lambda, forces[CONTACT]));
  PetscCall(VecAXPY(forces[RESIDUAL], -1.0, forces[CONTACT]));
  PetscCall(VecDuplicate(fields->lambda, &lambda));
  PetscCall(CertificateDirectionPart_Private(fields, PETSC_TRUE, lambda, forces[OBSTACLE]));
  PetscCall(CertificateDirectionPart_Private(fields, PETSC_FALSE, lambda, forces[MESHES]));
  PetscCall(VecDestroy(&lambda));
  PetscCall(CertificateNodeRounding_Private(fields, forces[NOISE]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Splits the residual of one node into held directions and the rest: reaction = -sum_k (d_k.r) d_k, r := r +
   reaction. */
static void CertificateSplitResidual_Private(const Support *support, PetscInt a, PetscReal r[], PetscReal reaction[])
{
  const PetscInt dim = support->dim;

  for (PetscInt k = 0; k < dim; k++) reaction[k] = 0.0;
  for (PetscInt j = 0; j < support->count[a]; j++) {
    const PetscReal *d     = &support->directions[(a * dim + j) * dim];
    PetscReal        share = 0.0;

    for (PetscInt k = 0; k < dim; k++) share += d[k] * r[k];
    for (PetscInt k = 0; k < dim; k++) reaction[k] -= share * d[k];
  }
  for (PetscInt k = 0; k < dim; k++) r[k] += reaction[k];
}

/* moment += x cross F, three components, absent ones 0. */
static void CertificateAddMoment_Private(PetscInt dim, const PetscReal x[], const PetscReal F[], PetscReal moment[3])
{
  PetscReal X[3] = {0, 0, 0}, Y[3] = {0, 0, 0}, part[3];

  for (PetscInt k = 0; k < dim; k++) {
    X[k] = x[k];
    Y[k] = F[k];
  }
  VectorCross(X, Y, part);
  for (PetscInt k = 0; k < 3; k++) moment[k] += part[k];
}

/* Adds one node's forces to the sums. [in] x - from the centre; F - [FORCE_COUNT][dim], the residual without
   the reaction. */
static void CertificateAddNode_Private(ModelKind model, const PetscReal x[], const PetscReal F[FORCE_COUNT][3],
                                       PetscReal stiffness, PetscReal u_max, const PetscReal u[], PetscReal sums[])
{
  const PetscInt  dim      = model == MODEL_SOLID ? 3 : 2;
  const PetscBool ring     = (PetscBool)(model == MODEL_AXISYMMETRIC);
  const PetscReal roundoff = FIELDS_ROUNDOFF * stiffness * u_max + VectorNorm(dim, F[NOISE]), arm = VectorNorm(dim, x);
  PetscReal       outer[3], size, work = 0.0;

  for (PetscInt k = 0; k < dim; k++) {
    outer[k] = F[LOADS][k] + F[REACTION][k] - F[OBSTACLE][k];
    if (k > 0 || !ring) sums[SUM_FORCE + k] += outer[k];
    work += PetscAbsReal((F[LOADS][k] + F[REACTION][k]) * u[k]) + PetscAbsReal(F[INNER][k] * u[k]);
    sums[SUM_ENERGY] += F[INNER][k] * u[k];
  }
  if (!ring) {
    CertificateAddMoment_Private(dim, x, outer, &sums[SUM_MOMENT]);
    CertificateAddMoment_Private(dim, x, F[MESHES], &sums[SUM_PAIRMOMENT]);
  }
  size = VectorNorm(dim, F[LOADS]) + VectorNorm(dim, F[CONTACT]) + VectorNorm(dim, F[REACTION]);
  sums[SUM_SIZES] += size;
  sums[SUM_SIZES + 1] += arm * size;
  sums[SUM_SIZES + 2] += roundoff;
  sums[SUM_SIZES + 3] += arm * roundoff;
  sums[SUM_WORK] += work;
  sums[SUM_WORK_ROUNDOFF] += roundoff * u_max;
  sums[SUM_FREE] += PetscSqr(VectorNorm(dim, F[RESIDUAL])) / stiffness;
  sums[SUM_LOADS] += PetscSqr(VectorNorm(dim, F[LOADS])) / stiffness;
  sums[SUM_INNER] += PetscSqr(VectorNorm(dim, F[INNER])) / stiffness;
  sums[SUM_CONTACT] += PetscSqr(VectorNorm(dim, F[CONTACT])) / stiffness;
  sums[SUM_ROUNDOFF] += PetscSqr(roundoff) / stiffness;
}

/* Nodes: reactions, sums of forces, and how far the supports are from their data. */
static PetscErrorCode CertificateSumNodes_Private(Fields fields, Vec reactions, PetscReal sums[], PetscReal largest[])
{
  const VI         vi      = fields->vi;
  const Level     *level   = vi->level;
  const Support   *support = &vi->support;
  const PetscInt   dim     = level->dim;
  PetscReal        lower[3], upper[3], centre[3];
  const PetscReal *force[FORCE_COUNT], *u;
  PetscReal       *reaction;
  Vec              forces[FORCE_COUNT];

  PetscFunctionBeginUser;
  PetscCall(LevelGetBox(level, -1, lower, upper));
  for (PetscInt k = 0; k < dim; k++)
    centre[k] = 0.5 * (upper[k] + lower[k]); // moments about it do not depend on the place
  PetscCall(CertificateCreateForces_Private(fields, forces));
  for (PetscInt i = 0; i < FORCE_COUNT; i++) PetscCall(VecGetArrayRead(forces[i], &force[i]));
  PetscCall(VecGetArrayRead(fields->u, &u));
  PetscCall(VecGetArray(reactions, &reaction));
  for (PetscInt a = 0; a < level->num_owned; a++) {
    PetscReal F[FORCE_COUNT][3] = {{0}}, x[3];

    for (PetscInt k = 0; k < dim; k++) {
      for (PetscInt i = 0; i < FORCE_COUNT; i++) F[i][k] = force[i][a * dim + k];
      x[k] = level->coords[a * dim + k] - centre[k];
    }
    CertificateSplitResidual_Private(support, a, F[RESIDUAL], F[REACTION]);
    if (vi->scene->model == MODEL_AXISYMMETRIC) x[0] = 0;
    for (PetscInt k = 0; k < dim; k++) reaction[a * dim + k] = F[REACTION][k];
    CertificateAddNode_Private(vi->scene->model, x, F, fields->stiffness[a], fields->body_max[level->node_body[a]],
                               &u[a * dim], sums);
    for (PetscInt j = 0; j < support->count[a]; j++) {
      PetscReal miss = -support->values[a * dim + j];

      for (PetscInt k = 0; k < dim; k++) miss += support->directions[(a * dim + j) * dim + k] * u[a * dim + k];
      largest[MAX_GAP] = PetscMax(largest[MAX_GAP], PetscAbsReal(miss));
    }
  }
  PetscCall(VecRestoreArray(reactions, &reaction));
  PetscCall(VecRestoreArrayRead(fields->u, &u));
  for (PetscInt i = 0; i < FORCE_COUNT; i++) {
    PetscCall(VecRestoreArrayRead(forces[i], &force[i]));
    PetscCall(VecDestroy(&forces[i]));
  }
  PetscCall(LevelShareVec(reactions, INSERT_VALUES));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The force of a row of contact: a pressure on a weight below zero pulls. An open row has the remaining
   residual of the solver, which the test of tension measures. Sides that do not meet have no forces to
   compare it with. */
static void CertificateAddForce_Private(Fields fields, PetscInt r, PetscReal lambda, PetscReal limit, PetscReal sums[])
{
  const PetscReal weight = fields->row_weight[r], force = lambda * weight;

  if (StatusIsContact(fields->row_status[r])) sums[SUM_PULL] += PetscMax(-force, 0.0);
  sums[SUM_PRESS] += PetscAbsReal(force) + fields->row_noise[r] * PetscAbsReal(weight) / limit;
  sums[SUM_WEIGHTLESS] += fields->vi->row_D[r] > 0 && weight > 0 ? 0 : 1;
}

/* Rows: penetration, tension, complementarity. Tied rows must vanish, whatever their multiplier is. */
static PetscErrorCode CertificateSumRows_Private(Fields fields, PetscReal limit, PetscReal sums[], PetscReal largest[])
{
  const VI         vi = fields->vi;
  const PetscReal *lambda, *slack;

  PetscFunctionBeginUser;
  PetscCall(VecGetArrayRead(fields->lambda, &lambda));
  PetscCall(VecGetArrayRead(fields->slack, &slack));
  for (PetscInt r = 0; r < vi->num_rows; r++) {
    if (fields->row_status[r] == STATUS_TIED) {
      largest[MAX_GAP] = PetscMax(largest[MAX_GAP], PetscAbsReal(slack[r]));
      continue;
    }
    if (vi->row_direction[r]) continue; // friction has a law of its own
    CertificateAddForce_Private(fields, r, lambda[r], limit, sums);
    largest[MAX_GAP] = PetscMax(largest[MAX_GAP], -slack[r]);
    /* Per row, because the roundoff of a row with little coverage is larger. */
    largest[MAX_PRESSURE] =
        PetscMax(largest[MAX_PRESSURE],
                 CertificateRatio_Private(PetscMax(-lambda[r], 0.0), fields->p_ref, fields->row_noise[r], limit));
    sums[SUM_COMPLEMENTARITY] += vi->row_D[r] * PetscAbsReal(lambda[r] * slack[r]);
    sums[SUM_COMPLEMENTARITY_ROUNDOFF] += vi->row_D[r] * fields->row_noise[r] * PetscAbsReal(slack[r]);
  }
  PetscCall(VecRestoreArrayRead(fields->slack, &slack));
  PetscCall(VecRestoreArrayRead(fields->lambda, &lambda));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The size of the nodal forces. */
static PetscReal CertificateForceSize_Private(const PetscReal sums[])
{
  return PetscSqrtReal(sums[SUM_LOADS]) + PetscSqrtReal(sums[SUM_INNER]) + PetscSqrtReal(sums[SUM_CONTACT]);
}

/* Whether no loads act and all forces are roundoff: bodies rest after a rigid motion. Of a motion much longer
   than the body this is not known: roundoff then hides strains that count. Collective. */
static PetscErrorCode CertificateIsAtRest_Private(Fields fields, const PetscReal sums[], PetscBool *rest)
{
  const Level *level = fields->vi->level;
  PetscReal    lower[3], upper[3];

  PetscFunctionBeginUser;
  *rest = (PetscBool)(sums[SUM_LOADS] == 0.0 &&
                      CertificateForceSize_Private(sums) <= REST * PetscSqrtReal(sums[SUM_ROUNDOFF]));
  for (PetscInt b = 0; *rest && b < fields->vi->scene->num_bodies; b++) {
    PetscReal length = 0;

    PetscCall(LevelGetBox(level, b, lower, upper));
    for (PetscInt k = 0; k < level->dim; k++) length = PetscMax(length, upper[k] - lower[k]);
    if (fields->body_max[b] > LONG_MOTION * length) *rest = PETSC_FALSE;
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The roundoff of the nodal forces over their size; 0 at rest. Collective. */
static PetscErrorCode CertificateSetRounding_Private(Fields fields, const PetscReal sums[], Certificate *c)
{
  const PetscReal roundoff = PetscSqrtReal(sums[SUM_ROUNDOFF]);
  PetscBool       rest;

  PetscFunctionBeginUser;
  PetscCall(CertificateIsAtRest_Private(fields, sums, &rest));
  c->rounding =
      rest || roundoff == 0.0 ? 0 : NODE_ROUNDING / FIELDS_ROUNDOFF * roundoff / CertificateForceSize_Private(sums);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The displacement that gaps are compared with: work of the forces over their sum. So a rigid motion does not
   hide an overlap. Without forces all displacements are rigid. */
static PetscReal CertificateStretch_Private(Fields fields, const PetscReal sums[])
{
  if (sums[SUM_SIZES] == 0.0) return fields->u_ref;
  return PetscMin(PetscMax(sums[SUM_ENERGY], 0.0) / sums[SUM_SIZES], fields->u_ref);
}

/* Turns the sums of all ranks into the dimensionless tests. [in,out] c - its limit is given */
static void CertificateSetRatios_Private(Fields fields, const PetscReal sums[], const PetscReal largest[],
                                         Certificate *c)
{
  const PetscReal limit = c->limit;
  PetscReal       rest[3];

  c->equilibrium     = CertificateRatio_Private(PetscSqrtReal(sums[SUM_FREE]), CertificateForceSize_Private(sums),
                                                PetscSqrtReal(sums[SUM_ROUNDOFF]), limit);
  c->gap             = CertificateRatio_Private(largest[MAX_GAP], CertificateStretch_Private(fields, sums),
                                                FIELDS_ROUNDOFF * fields->u_ref, limit);
  c->pressure        = largest[MAX_PRESSURE];
  c->pull            = CertificateRatio_Private(sums[SUM_PULL], sums[SUM_PRESS], 0.0, limit);
  c->weightless      = (PetscInt)sums[SUM_WEIGHTLESS];
  c->energy_norm     = PetscSqrtReal(PetscMax(sums[SUM_ENERGY], 0.0));
  c->complementarity = CertificateRatio_Private(sums[SUM_COMPLEMENTARITY], sums[SUM_WORK],
                                                sums[SUM_WORK_ROUNDOFF] + sums[SUM_COMPLEMENTARITY_ROUNDOFF], limit);
  for (PetscInt k = 0; k < 3; k++) rest[k] = sums[SUM_MOMENT + k] - sums[SUM_PAIRMOMENT + k];
  c->force  = CertificateRatio_Private(VectorNorm(3, &sums[SUM_FORCE]), sums[SUM_SIZES], sums[SUM_SIZES + 2], limit);
  c->moment = CertificateRatio_Private(VectorNorm(3, rest), sums[SUM_SIZES + 1], sums[SUM_SIZES + 3], limit);
  c->pair_moment =
      CertificateRatio_Private(VectorNorm(3, &sums[SUM_PAIRMOMENT]), sums[SUM_SIZES + 1], sums[SUM_SIZES + 3], limit);
}

/* The first test that does not hold, as a sentence. A NAN holds nothing. [in] stopped - whether at the
   discretisation error */
static PetscErrorCode CertificateDecide_Private(PetscBool stopped, Certificate *c)
{
  static const char coarse[] = "the mesh is too coarse to stop at its error; omit -stop discretisation";
  static const char solver[] = "tighten -ksp_rtol, or omit -ksp_type and -pc_type";
  static const char mesh[]   = "check the cells of that side, or exchange -<pair>_nonmortar and -<pair>_mortar";
  static const char set[]    = "raise -snes_max_it, tighten -ksp_rtol, or try -cross_check";
  const struct {
    const char *name;
    PetscReal   value;
    const char *advice;
  } tests[] = {
      {"equilibrium of the nodal forces", c->equilibrium, solver},
      {"penetration, or deviation from prescribed displacements,", c->gap, set},
      {"tension in a contact", c->pressure, set},
      {"complementarity of pressure and gap", c->complementarity, set},
      {"the tensile part of the contact forces", c->pull, mesh},
      {"a tangential traction beyond the limit of friction", c->friction.cone, set},
      {"slip against the law of friction", c->friction.slip, set},
      {"work that friction returns", c->friction.dissipation, set},
      {"balance of forces", c->force, solver},
      {"balance of moments", c->moment, solver},
  };

  PetscFunctionBeginUser;
  c->failure[0] = '\0';
  c->holds      = (PetscBool)(c->rounding <= TOLERANCE);
  if (!c->holds)
    PetscCall(
        PetscSNPrintf(c->failure, sizeof(c->failure),
                      "the certificate fails: roundoff is %.2g of the nodal forces, limit %.0e; displacements are "
                      "too large beside the strains: support bodies that only friction or nothing holds, or place "
                      "them nearer to contact",
                      (double)c->rounding, (double)TOLERANCE));
  for (size_t i = 0; i < sizeof(tests) / sizeof(tests[0]) && c->holds; i++) {
    if (tests[i].value <= c->limit) continue;
    c->holds = PETSC_FALSE;
    PetscCall(PetscSNPrintf(c->failure, sizeof(c->failure), "the certificate fails: %s is %.2g, limit %.0e; %s",
                            tests[i].name, (double)tests[i].value, (double)c->limit,
                            stopped ? coarse : tests[i].advice));
  }
  if (c->weightless && c->holds) {
    c->holds = PETSC_FALSE;
    PetscCall(PetscSNPrintf(c->failure, sizeof(c->failure),
                            "the certificate fails: %" PetscInt_FMT
                            " contact nodes have a weight of zero or less, so their pressure gives no force; %s",
                            c->weightless, mesh));
  }
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode CertificateCompute(Fields fields, Certificate *certificate, Vec *reactions)
{
  const MPI_Comm  comm            = fields->vi->level->comm;
  const PetscBool stopped         = (PetscBool)(fields->vi->scene->stop == STOP_DISCRETISATION);
  const PetscReal limit           = stopped ? STOPPED_TOLERANCE : TOLERANCE;
  PetscReal       sums[SUM_COUNT] = {0}, largest[MAX_COUNT] = {0}, size[2] = {0, 0};

  PetscFunctionBeginUser;
  PetscCall(PetscMemzero(certificate, sizeof(*certificate)));
  certificate->limit = limit;
  PetscCall(VecDuplicate(fields->u, reactions));
  PetscCall(VecNorm(fields->u, NORM_2, &size[0]));
  if (fields->lambda) PetscCall(VecNorm(fields->lambda, NORM_2, &size[1]));
  if (PetscIsInfOrNanReal(size[0]) || PetscIsInfOrNanReal(size[1])) {
    /* A maximum would lose a NAN on its way. */
    PetscCall(VecSet(*reactions, NAN));
    *certificate =
        (Certificate){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, {NAN, NAN, NAN}, .energy_norm = NAN, .limit = limit};
    PetscCall(PetscSNPrintf(certificate->failure, sizeof(certificate->failure),
                            "the solution has numbers that are not finite; the linear systems may be singular: look "
                            "for an unsupported body, or try -pc_type lu"));
    PetscFunctionReturn(PETSC_SUCCESS);
  }
  PetscCall(CertificateSumNodes_Private(fields, *reactions, sums, largest));
  if (fields->lambda) PetscCall(CertificateSumRows_Private(fields, limit, sums, largest));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, SUM_COUNT, MPIU_REAL, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, MAX_COUNT, MPIU_REAL, MPI_MAX, comm));
  CertificateSetRatios_Private(fields, sums, largest, certificate);
  PetscCall(CertificateSetRounding_Private(fields, sums, certificate));
  PetscCall(FrictionResidualCompute(fields, limit, &certificate->friction));
  PetscCall(CertificateDecide_Private(stopped, certificate));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscReal CertificateRelative(const Certificate *certificate, PetscReal error)
{
  return isgreater(certificate->energy_norm, 0) ? error / certificate->energy_norm : NAN;
}
