/* five_loads.c -- a scene at five loads: prints the force of its first pair. C and C++ alike.

   five_loads -options_file scene.opts -pair joint */
#include <mortise.h>

static PetscErrorCode SolveLoads(void)
{
  Mortise   m;
  char      pair[64] = "joint";
  PetscReal force[3], energy;
  int       status;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetString(NULL, NULL, "-pair", pair, sizeof(pair),
                                  NULL)); /* the caller's own: before the scene is read */
  PetscCall(MortiseCreate(PETSC_COMM_WORLD, &m));
  PetscCall(MortiseSetFromOptions(m));
  for (int step = 1; step <= 5; ++step) {
    PetscCall(MortiseSetTime(m, 0.2 * step));
    PetscCall(MortiseSolve(m));
    PetscCall(MortiseGetStatus(m, &status));
    PetscCall(MortiseGetPairForce(m, pair, force, NULL));
    PetscCall(MortiseGetEnergy(m, &energy, NULL));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "load %g status %d force %.12g %.12g energy %.12g\n", 0.2 * step, status,
                          (double)force[0], (double)force[1], (double)energy));
  }
  PetscCall(MortiseDestroy(&m));
  PetscFunctionReturn(PETSC_SUCCESS);
}

int main(int argc, char **argv)
{
  PetscErrorCode error    = MortiseInitialize(&argc, &argv);
  const char    *sentence = "";

  if (!error) error = SolveLoads();
  if (error == MORTISE_ERR_USER) {
    MortiseGetError(&sentence);
    fprintf(stderr, "five_loads: %s\n", sentence);
  }
  if (error) return error == MORTISE_ERR_USER ? 1 : 4;
  return MortiseFinalize() ? 4 : 0;
}
