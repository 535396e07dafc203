/* launch.h -- whether a launcher started this process, and how MPI starts fast where none did. */
#ifndef MORTISE_LAUNCH_H
#define MORTISE_LAUNCH_H

#include <petscsys.h>

/* Whether the environment has a variable of a launcher of MPI: mpiexec, Slurm, Flux and others.
   Not collective; needs no MPI. */
PetscBool LaunchedByLauncher(void);
/* MPI_Init(). Where no launcher started the process, Open MPI starts no daemon and searches no network,
   unless the user has set these variables. Afterwards the environment is the user's again. Other
   implementations of MPI ignore these variables. Collective on all ranks. */
void LaunchMPI(int *argc, char ***argv);

#endif
