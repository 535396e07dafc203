/* test_solvefaults.c -- solver options that cannot be are told in one sentence. What a fault leaves is not freed. */
#include "base/usererror.h"
#include "pdas/pdas.h"
#include <string.h>
#include "membrane.h"

/* Options that cannot be are faults in one sentence that names them. */
static PetscErrorCode TestFaults(void)
{
  static const char *const mistakes[][2] = {{"-snes_type newtonls", "-snes_type"},
                                            {"-snes_type pdass", "pdass"},
                                            {"-snes_type vinewtonrsls -pc_type gamg", "-pc_type gamg"},
                                            {"-snes_pdas_c -1", "-snes_pdas_c"},
                                            {"-snes_pdas_start middle", "middle"},
                                            {"-ksp_type cgg", "cgg"},
                                            {"-pc_type gamm", "gamm"},
                                            {"-snes_max_it many", "many"}};
  Membrane                 m;
  SolverReport             report;
  Vec                      y;

  PetscFunctionBeginUser;
  PetscCall(MembraneCreate(1, 1, PETSC_TRUE, PETSC_TRUE, &m));
  PetscCall(VecDuplicate(m.vi.b, &y));
  for (size_t k = 0; k < PETSC_STATIC_ARRAY_LENGTH(mistakes); k++) {
    PetscOptions own;

    PetscCall(PetscOptionsCreate(&own));
    PetscCall(PetscOptionsPush(own));
    PetscCall(PetscOptionsInsertString(own, mistakes[k][0]));
    CHECK(SolveOnce(&m.vi, NULL, NULL, y, &report) == MORTISE_ERR_USER);
    CHECK(strstr(UserErrorSentence(), mistakes[k][1]));
    PetscCall(PetscOptionsPop());
    PetscCall(PetscOptionsDestroy(&own));
  }
  PetscCall(VecDestroy(&y));
  PetscCall(MembraneDestroy(&m));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(UserErrorInitialize());
  PetscCall(PDASRegister());
  PetscCall(TestFaults());
  PetscCall(PetscFinalize());
  return 0;
}
