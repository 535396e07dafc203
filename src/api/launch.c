/* launch.c -- see the header.

   Open MPI starts a daemon for a process without a launcher, and asks every network library of the machine.
   Together they take five times as long as a small scene. A parameter in the user's environment wins. */
#include "api/launch.h"
#include <stdlib.h>

/* Variables that a launcher leaves in the environment of each rank. */
static const char *const launchers[] = {
    "OMPI_COMM_WORLD_SIZE", "PMIX_RANK",      "PMI_RANK",           "PMI_FD",      "PMI_SIZE",    "MPI_LOCALNRANKS",
    "SLURM_PROCID",         "FLUX_TASK_RANK", "JSM_NAMESPACE_RANK", "PALS_RANKID", "ALPS_APP_PE", "MV2_COMM_WORLD_SIZE",
    "MPIRUN_RANK"};

/* Settings for a process alone: no daemon; no folder in TMPDIR, which such processes would share: one removes
   it while another makes its own in it. No network for messages; no list of the machine's cards and
   displays. */
static const struct {
  const char *name, *value;
} alone[] = {{"OMPI_MCA_ess_singleton_isolated", "1"},
             {"OMPI_MCA_orte_create_session_dirs", "0"},
             {"OMPI_MCA_pml", "ob1"},
             {"HWLOC_COMPONENTS", "-pci,-linuxio,-gl,-opencl"}};

PetscBool LaunchedByLauncher(void)
{
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(launchers); i++)
    if (getenv(launchers[i])) return PETSC_TRUE;
  return PETSC_FALSE;
}

void LaunchMPI(int *argc, char ***argv)
{
  const PetscBool launched                              = LaunchedByLauncher();
  PetscBool       set[PETSC_STATIC_ARRAY_LENGTH(alone)] = {PETSC_FALSE};

  for (size_t i = 0; !launched && i < PETSC_STATIC_ARRAY_LENGTH(alone); i++)
    set[i] = (PetscBool)(!getenv(alone[i].name) && !setenv(alone[i].name, alone[i].value, 0));
  MPI_Init(argc, argv);
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(alone); i++)
    if (set[i]) unsetenv(alone[i].name);
}
