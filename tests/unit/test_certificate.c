/* test_certificate.c -- the certificate holds for a solution, and fails for every way of not being one. */
#include "solve_once.h"
#include "test.h"
#include "two_boxes.h"
#include <math.h>
#include "result/certificate.h"
#include "base/log.h"
#include "pdas/pdas.h"
#include <string.h>
#include "result/pairsum.h"

typedef struct {
  struct _n_Scene scene;
  SceneBody       bodies[2];
  ScenePair       pair;
  SceneBoundary   boundaries[2];
  Mesh            mesh;
  VI              vi;
  Vec             y;
  Fields          fields;
} Case;

/* An upper box on [0,1] x [0,1], pushed down by `push`, over a lower one on [0.4,1.6] x [-1,0]. It is half
   covered, so that nodes are removed, open and in contact. */
static PetscErrorCode Solve(Case *c, PetscReal push)
{
  const PetscReal down[2] = {0, -push}, held[2] = {0, 0};
  SolverReport    report;

  PetscFunctionBeginUser;
  PetscCall(SetTwoBoxes(&c->scene, c->bodies, &c->pair));
  SetBox(&c->bodies[0], "upper", 6, 5, 0, 0, 1, 1);
  SetBox(&c->bodies[1], "lower", 7, 4, 0.4, -1, 1.6, 0);
  for (PetscInt b = 0; b < 2; b++) {
    c->boundaries[b]            = (SceneBoundary){BOUNDARY_DISPLACEMENT, (char *)(b ? "bottom" : "top"), NULL};
    c->bodies[b].num_boundaries = 1;
    c->bodies[b].boundaries     = &c->boundaries[b];
    PetscCall(ConstantCreate("-bc", 2, b ? held : down, &c->boundaries[b].value));
  }
  c->scene.quiet = PETSC_TRUE;
  PetscCall(MeshCreate(&c->scene, &c->mesh));
  PetscCall(MeshSetUp(c->mesh));
  PetscCall(VICreate(&c->scene, c->mesh, &c->vi));
  PetscCall(VecDuplicate(c->vi->b, &c->y));
  PetscCall(SolveOnce(c->vi, NULL, NULL, c->y, &report));
  CHECK(report.converged);
  PetscCall(FieldsCreate(c->vi, NULL, c->y, &c->fields));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Destroy(Case *c)
{
  PetscFunctionBeginUser;
  PetscCall(FieldsDestroy(&c->fields));
  PetscCall(VecDestroy(&c->y));
  PetscCall(VIDestroy(&c->vi));
  PetscCall(MeshDestroy(&c->mesh));
  PetscCall(DestroyTwoBoxes(c->bodies));
  PetscFunctionReturn(PETSC_SUCCESS);
}

static PetscErrorCode Certify(Case *c, Certificate *certificate)
{
  Vec reactions;

  PetscFunctionBeginUser;
  PetscCall(CertificateCompute(c->fields, certificate, &reactions));
  PetscCall(VecDestroy(&reactions));
  CHECK(certificate->holds == (PetscBool)!certificate->failure[0]);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* The solution: everything at the level of rounding; what the support exerts is what the contact passes on. */
static PetscErrorCode TestSolution(Case *c)
{
  Certificate      certificate;
  Vec              reactions;
  PairSum          sum;
  PetscReal        pushed[2] = {0, 0};
  const PetscReal *r;

  PetscFunctionBeginUser;
  PetscCall(CertificateCompute(c->fields, &certificate, &reactions));
  CHECK(certificate.holds);
  CHECK_NEAR(certificate.equilibrium, 0, 1e-12);
  CHECK_NEAR(certificate.gap, 0, 1e-12);
  CHECK_NEAR(certificate.pressure, 0, 1e-12);
  CHECK_NEAR(certificate.complementarity, 0, 1e-12);
  CHECK_NEAR(certificate.force, 0, 1e-12);
  CHECK_NEAR(certificate.moment, 0, 1e-12);
  CHECK_NEAR(certificate.pair_moment, 0, 1e-12);
  PetscCall(VecGetArrayRead(reactions, &r));
  for (PetscInt a = 0; a < c->vi->level->num_owned; a++) {
    if (c->vi->level->node_body[a] != 0) continue;
    for (PetscInt k = 0; k < 2; k++) pushed[k] += r[2 * a + k];
  }
  PetscCall(VecRestoreArrayRead(reactions, &r));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, pushed, 2, MPIU_REAL, MPI_SUM, PETSC_COMM_WORLD));
  PetscCall(PairSumCompute(c->fields, 0, &sum));
  CHECK(sum.active > 0 && sum.force[1] > 0);
  CHECK_NEAR(sum.force[0], 0, 1e-12);
  CHECK_NEAR(sum.force[1] / sum.normal_force, 1, 1e-12);
  CHECK_NEAR(pushed[0], 0, 1e-9 * sum.force[1]);
  CHECK_NEAR(pushed[1] / sum.force[1], -1, 1e-12);
  CHECK(sum.area <= 0.6 + 1e-12 && sum.upper[0] == 1.0 && sum.lower[1] == 0.0);
  CHECK_NEAR(sum.moment_imbalance, 0, 1e-12);
  PetscCall(VecDestroy(&reactions));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Adds `by` to entry i of the global vector v, as the owner does. */
static PetscErrorCode Spoil(Vec v, PetscInt i, PetscReal by)
{
  PetscFunctionBeginUser;
  PetscCall(VecSetOption(v, VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE));
  PetscCall(VecSetValue(v, i, by, ADD_VALUES));
  PetscCall(VecAssemblyBegin(v));
  PetscCall(VecAssemblyEnd(v));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* Every block spoilt on its own, by little: the test that watches it sees it. */
static PetscErrorCode TestSpoilt(Case *c, PetscReal push)
{
  Certificate       certificate;
  const PetscMPIInt first = 0;
  PetscMPIInt       rank;
  Vec               u, lambda, slack;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  PetscCall(VecDuplicate(c->fields->u, &u));
  PetscCall(VecDuplicate(c->fields->lambda, &lambda));
  PetscCall(VecDuplicate(c->fields->slack, &slack));
  PetscCall(VecCopy(c->fields->u, u));
  PetscCall(VecCopy(c->fields->lambda, lambda));
  PetscCall(VecCopy(c->fields->slack, slack));

  PetscCall(Spoil(c->fields->u, rank == first ? 0 : -1, 1e-5 * push));
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && (certificate.equilibrium > 1e-7 || certificate.gap > 1e-7));
  PetscCall(VecCopy(u, c->fields->u));

  PetscCall(Spoil(c->fields->lambda, rank == first ? 0 : -1, -2 * c->fields->p_ref));
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && certificate.pressure > 0.9 && certificate.equilibrium > 1e-4);
  CHECK(strstr(certificate.failure, "equilibrium"));
  PetscCall(VecCopy(lambda, c->fields->lambda));

  PetscCall(Spoil(c->fields->slack, rank == first ? 0 : -1, -2 * c->fields->u_ref));
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && certificate.gap > 0.9);
  CHECK(strstr(certificate.failure, "penetration"));
  c->scene.stop = STOP_DISCRETISATION; // what to do then is not a matter of the solver
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && strstr(certificate.failure, "omit -stop discretisation"));
  c->scene.stop = STOP_RESIDUAL;
  PetscCall(VecCopy(slack, c->fields->slack));

  PetscCall(Spoil(c->fields->u, rank == first ? 1 : -1, NAN));
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && isnan(certificate.equilibrium) && isnan(certificate.gap));
  PetscCall(VecCopy(u, c->fields->u));

  PetscCall(Certify(c, &certificate));
  CHECK(certificate.holds);
  PetscCall(VecDestroy(&u));
  PetscCall(VecDestroy(&lambda));
  PetscCall(VecDestroy(&slack));
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A row of each rank has another weight than before. All equations hold. Still its force pulls where the
   weight is below zero, or there is no force for its pressure. */
static PetscErrorCode TestWeights(Case *c)
{
  PetscReal       *weight = c->fields->row_weight, kept = 0, part[3] = {0, 0, 0};
  const PetscReal *lambda;
  PetscInt         r = 0;
  Certificate      certificate;

  PetscFunctionBeginUser;
  while (r < c->vi->num_rows && c->fields->row_status[r] != STATUS_CONTACT) r++;
  PetscCall(VecGetArrayRead(c->fields->lambda, &lambda));
  for (PetscInt i = 0; i < c->vi->num_rows; i++) part[0] += PetscAbsReal(lambda[i] * weight[i]);
  if (r < c->vi->num_rows) {
    kept      = weight[r];
    part[1]   = lambda[r] * kept;
    part[2]   = 1;
    weight[r] = -kept;
  }
  PetscCall(VecRestoreArrayRead(c->fields->lambda, &lambda));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, part, 3, MPIU_REAL, MPI_SUM, PETSC_COMM_WORLD));
  CHECK(part[1] > 0);
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && strstr(certificate.failure, "tensile part"));
  CHECK_NEAR(certificate.pull / (part[1] / part[0]), 1, 1e-6);
  CHECK(certificate.equilibrium < 1e-12 && certificate.pressure < 1e-12);

  if (r < c->vi->num_rows) weight[r] = 0;
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && strstr(certificate.failure, "weight of zero"));
  CHECK(certificate.weightless == (PetscInt)part[2] && certificate.pull < 1e-12);

  if (r < c->vi->num_rows) weight[r] = kept;
  PetscCall(Certify(c, &certificate));
  CHECK(certificate.holds);
  PetscFunctionReturn(PETSC_SUCCESS);
}

/* A rigid motion beside which the strains are lost fails; and it hides no overlap. */
static PetscErrorCode TestRigidMotion(Case *c, PetscReal push)
{
  const PetscReal   largest = c->fields->body_max[0], u_ref = c->fields->u_ref;
  const PetscMPIInt first = 0;
  PetscMPIInt       rank;
  Certificate       certificate;
  Vec               slack;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  for (PetscReal factor = 1e3; factor < 1e13; factor *= 1e8) {
    c->fields->body_max[0] = factor * largest;
    PetscCall(Certify(c, &certificate));
    CHECK(certificate.holds == (PetscBool)(factor < 1e6) && certificate.equilibrium < 1e-12);
    CHECK(certificate.holds || strstr(certificate.failure, "roundoff"));
  }
  c->fields->body_max[0] = largest;

  PetscCall(VecDuplicate(c->fields->slack, &slack));
  PetscCall(VecCopy(c->fields->slack, slack));
  c->fields->u_ref = 1e6 * u_ref;
  PetscCall(Spoil(c->fields->slack, rank == first ? 0 : -1, -0.1 * push));
  PetscCall(Certify(c, &certificate));
  CHECK(!certificate.holds && certificate.gap > 1e-3 && strstr(certificate.failure, "penetration"));
  PetscCall(VecCopy(slack, c->fields->slack));
  PetscCall(VecDestroy(&slack));
  c->fields->u_ref = u_ref;
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  static const PetscReal pushes[] = {1e-2, 1e-8}; /* nothing depends on the size of the answer */
  Case                   c;
  Certificate            certificate;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  PetscCall(LogInitialize(LogWallClock()));
  PetscCall(PDASRegister());
  for (int i = 0; i < 2; i++) {
    PetscCall(Solve(&c, pushes[i]));
    PetscCall(TestSolution(&c));
    PetscCall(TestSpoilt(&c, pushes[i]));
    PetscCall(TestWeights(&c));
    PetscCall(TestRigidMotion(&c, pushes[i]));
    PetscCall(Destroy(&c));
  }
  /* Nothing pushes, nothing moves: solved, with all zeros. */
  PetscCall(Solve(&c, 0));
  PetscCall(Certify(&c, &certificate));
  CHECK(certificate.holds && certificate.equilibrium == 0 && certificate.force == 0 && certificate.gap == 0);
  PetscCall(Destroy(&c));
  PetscCall(PetscFinalize());
  return 0;
}
