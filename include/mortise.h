/* mortise.h -- the public interface of Mortise: contact of elastic bodies, as one object in PETSc's idiom.
   A program reads a scene from options, solves it, and asks for numbers:

       Mortise   m;
       PetscReal force[3];
       PetscCall(MortiseInitialize(&argc, &argv));         the scene: ./program -options_file scene.opts
       PetscCall(MortiseCreate(PETSC_COMM_WORLD, &m));
       PetscCall(MortiseSetFromOptions(m));
       for (int step = 1; step <= 5; ++step) {
         PetscCall(MortiseSetTime(m, 0.2 * step));         all loads times 0.2, 0.4, ..., 1
         PetscCall(MortiseSolve(m));
         PetscCall(MortiseGetPairForce(m, "joint", force, NULL));
       }
       PetscCall(MortiseDestroy(&m));
       PetscCall(MortiseFinalize());
   Every function returns 0, MORTISE_ERR_USER for a mistake (see MortiseGetError()), or an error code of
   PETSc. Mistakes are those of the scene, calls in a wrong order, and a handle or name that is NULL. They
   print nothing, nor does PetscCall() that returns one; in main() itself it ends the program. Functions are
   collective unless they say otherwise. Units are those of the scene. GUIDE.md has options and files. */
#ifndef MORTISE_H
#define MORTISE_H

#include <petscdm.h>
#include <petscvec.h>
#include <petscviewer.h>

#if PETSC_VERSION_LT(3, 19, 0) /* programs are written for newer versions, too */
#define PETSC_SUCCESS 0
#endif
#if defined(__GNUC__)
#define MORTISE_PUBLIC __attribute__((visibility("default")))
#else
#define MORTISE_PUBLIC
#endif

#define MORTISE_VERSION_MAJOR    0
#define MORTISE_VERSION_MINOR    2
#define MORTISE_VERSION_SUBMINOR 0

/* Error code of a user's mistake, outside the range of PETSc's own codes. */
#define MORTISE_ERR_USER ((PetscErrorCode)4711)

#if defined(__cplusplus)
extern "C" {
#endif

/* A scene with its mesh and its last solution. */
typedef struct _p_Mortise *Mortise;

/* How a solve ended; the exit codes of the program. */
typedef enum {
  MORTISE_STATUS_SOLVED        = 0, /* solved, and the certificate holds */
  MORTISE_STATUS_NO_SOLUTION   = 2, /* nothing balances the loads */
  MORTISE_STATUS_NOT_CONVERGED = 3  /* not solved to tolerance, or a warning with -warnings error */
} MortiseStatus;

/* Status of a node on the nonmortar side of a pair. */
typedef enum {
  MORTISE_NODE_NONE    = -1, /* not on the side, or without a constraint */
  MORTISE_NODE_OPEN    = 0,
  MORTISE_NODE_CONTACT = 1, /* without friction */
  MORTISE_NODE_TIED    = 2,
  MORTISE_NODE_SLIP    = 3, /* in contact with friction, and it slides */
  MORTISE_NODE_STICK   = 4  /* in contact with friction, and it stays */
} MortiseNodeStatus;

/* Residuals of the answer in the uncondensed system, all dimensionless. */
typedef struct {
  PetscReal equilibrium;     /* |f - K u - B'lambda| over the size of the forces */
  PetscReal gap;             /* largest penetration, over the size of displacements that strain */
  PetscReal pressure;        /* largest tension, over the size of the pressures */
  PetscReal complementarity; /* pressure times gap, over the work of the loads */
  PetscReal force, moment;   /* balance of the whole scene */
  PetscReal friction;        /* largest violation of the law of friction; 0 without friction */
  PetscReal rounding, limit; /* roundoff of nodal forces over their size, limit 1e-6; limit of all others */
  PetscBool holds;
} MortiseCertificate;

/*@
   MortiseInitialize - Starts PETSc, or joins a PETSc that runs, and registers what Mortise adds to it.

   Collective on MPI_COMM_WORLD

   Input Parameters:
+  argc - number of arguments, or NULL
-  argv - arguments, or NULL; not changed

   Options Database Keys:
+  -options_file <file> - reads options from a file; the command line wins
-  -skip_petscrc        - leaves PETSc's own files of options alone

   Notes:
   If PETSc does not run, options files are read and checked here. A missing or malformed file, or a word that
   is no option, is a user error; PETSc is not started then. If PETSc runs already, pass NULL for both
   arguments. MPI is started if it does not run. Call MortiseFinalize() in either case, also after a mistake.

   Level: beginner
.seealso: MortiseFinalize(), MortiseGetError()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseInitialize(int *argc, char ***argv);

/*@
   MortiseFinalize - Ends what MortiseInitialize() has begun: PETSc and MPI, where it has started them.

   Collective on MPI_COMM_WORLD

   Notes:
   All handles are destroyed before. A PETSc of the caller goes on: the caller calls PetscFinalize() later.

   Level: beginner
.seealso: MortiseInitialize()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseFinalize(void);

/*@
   MortiseGetError - The sentence of the last mistake of the user, "" before any.

   Not Collective

   Output Parameter:
.  sentence - without a full stop; the same on all ranks; borrowed, until the next mistake

   Level: beginner
.seealso: MortiseInitialize(), MortiseSetFromOptions()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetError(const char **sentence);

/*@
   MortiseGetVersions - The versions of Mortise and of the libraries under it, one to a line.

   Not Collective; neither MPI nor PETSc need run

   Output Parameter:
.  text - borrowed, until the next call

   Level: intermediate
.seealso: MortiseInitialize()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetVersions(const char **text);

/*@
   MortisePrintHelp - Prints every option of a scene, with its unit and default, on standard output.

   Collective

   Input Parameter:
.  comm - its first rank prints

   Level: intermediate
.seealso: MortiseSetFromOptions()
@*/
MORTISE_PUBLIC PetscErrorCode MortisePrintHelp(MPI_Comm comm);

/*@
   MortiseCreate - Creates an empty handle.

   Collective

   Input Parameter:
.  comm - has all ranks of MPI_COMM_WORLD

   Output Parameter:
.  m - owned by the caller, MortiseDestroy()

   Notes:
   Several handles may exist at the same time. Give each a prefix by MortiseSetOptionsPrefix().

   Level: beginner
.seealso: MortiseSetFromOptions(), MortiseDestroy()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseCreate(MPI_Comm comm, Mortise *m);

/*@
   MortiseSetOptionsPrefix - Gives the handle options of its own: those of the database with a prefix.

   Logically Collective

   Input Parameters:
+  m      - the handle, before MortiseSetFromOptions()
-  prefix - such as "left_": the scene's -bodies is then -left_bodies, PETSc's -ksp_type is -left_ksp_type

   Notes:
   Without a prefix every option of PETSc's database counts as one of the scene, and an unread one is a
   mistake: a caller reads its own ones before MortiseSetFromOptions(), which copies options. With a prefix
   all others are ignored.

   Level: intermediate
.seealso: MortiseInsertFile(), MortiseSetFromOptions()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseSetOptionsPrefix(Mortise m, const char prefix[]);

/*@
   MortiseInsertFile - Reads an options file, as -options_file does.

   Collective

   Input Parameters:
+  m    - the handle, before MortiseSetFromOptions()
-  file - its path; names of meshes in it may be relative to its folder

   Notes:
   Options in the file have no prefix. With MortiseSetOptionsPrefix() they are the handle's alone, and else go
   into PETSc's database. The command line wins over the file.

   Level: beginner
.seealso: MortiseSetOptionsPrefix(), MortiseSetFromOptions()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseInsertFile(Mortise m, const char file[]);

/*@
   MortiseSetFromOptions - Reads the scene, and checks it as far as that can be done without its mesh.

   Collective

   Input Parameter:
.  m - the handle; what it had from an earlier call is destroyed

   Options Database Keys:
+  -bodies <name,name,...> - the scene, see MortisePrintHelp()
.  -quiet                  - warnings are kept in the summary alone
.  -monitor                - prints a line for every iteration
-  -output <path>          - files that MortiseWrite() writes

   Notes:
   An unread option is a mistake (-options_allow_unused makes it a warning). After a mistake the handle is
   empty; it can be destroyed, or filled again with other options. Warnings are lines on standard error.

   Level: beginner
.seealso: MortiseSetOptionsPrefix(), MortiseSetUp(), MortiseGetError()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseSetFromOptions(Mortise m);

/*@
   MortiseSetUp - Makes or reads the meshes, and shares them out among the ranks.

   Collective

   Input Parameter:
.  m - the handle, after MortiseSetFromOptions()

   Level: intermediate
.seealso: MortiseSolve(), which calls it, MortiseGetDM()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseSetUp(Mortise m);

/*@
   MortiseSetTime - Sets t for the solves that follow.

   Logically Collective

   Input Parameters:
+  m - the handle
-  t - a finite number; 1 in the beginning

   Notes:
   Formulas of the scene may name t. Where none does, t is a load factor: it multiplies loads, given
   displacements, gap offsets and temperatures, or what -load_steps_scale says. A map of a mesh cannot name t.
   Every solve is static. From this call on, solves keep matrices and factors, and take less time.

   Level: beginner
.seealso: MortiseSetDatum(), MortiseSolve()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseSetTime(Mortise m, PetscReal t);

/*@
   MortiseSetDatum - Replaces a load, a temperature, a given displacement or a gap of the scene by numbers.

   Collective

   Input Parameters:
+  m      - the handle, after MortiseSetFromOptions()
.  option - the option that gave the datum, without the handle's prefix
.  num    - number of components: the dimension, or 1 for a pressure or a gap
-  values - array of shape [num], in the unit of the option

   Notes:
   The scene has the option, which is one of -<body>_body_force, -<body>_bc_displacement_<side>, other
   -<body>_bc_<load>_<side>, -<body>_temperature, -<body>_initial_strain, -<body>_pretension, -<pair>_gap,
   -<pair>_gap_offset, -<pair>_obstacle_gap. Components that are `free` stay so. If t is a load factor it
   multiplies these numbers, too. A solve finds the strain of a new pretension, else keeps it.

   Level: intermediate
.seealso: MortiseSetTime(), MortiseSolve()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseSetDatum(Mortise m, const char option[], PetscInt num, const PetscReal values[]);

/*@
   MortiseSetInitialGuess - Sets where the next solve begins.

   Collective

   Input Parameters:
+  m - the handle, after MortiseSetUp()
-  u - displacement, in the layout of MortiseGetDisplacement(), copied; or NULL: from zero

   Notes:
   Counts for one solve, and changes its time only. By default the guess is from the last solutions, or zero.

   Level: advanced
.seealso: MortiseSolve(), MortiseGetDisplacement()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseSetInitialGuess(Mortise m, Vec u);

/*@
   MortiseSolve - Solves the scene and judges the answer.

   Collective

   Input Parameter:
.  m - the handle, after MortiseSetFromOptions()

   Notes:
   A scene without a solution and a solver that does not converge are no errors: ask MortiseGetStatus().
   Only warnings are printed. -load_steps and -study solve all; getters have the last step, none of a study.

   Level: beginner
.seealso: MortiseGetStatus(), MortiseSetTime(), MortiseSetInitialGuess(), MortiseWrite()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseSolve(Mortise m);

/*@
   MortiseGetStatus - How the last solve ended.

   Not Collective

   Input Parameter:
.  m - the handle, after MortiseSolve()

   Output Parameter:
.  exit_code - one of MortiseStatus

   Level: beginner
.seealso: MortiseSolve(), MortiseGetReason()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetStatus(Mortise m, int *exit_code);

/*@
   MortiseGetReason - Why the last solve has not found a solution, "" if it has.

   Not Collective

   Input Parameter:
.  m - the handle, after MortiseSolve()

   Output Parameter:
.  sentence - borrowed, until the next solve

   Level: beginner
.seealso: MortiseGetStatus()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetReason(Mortise m, const char **sentence);

/*@
   MortiseWrite - Writes the files that the scene asks for, each complete or not at all.

   Collective

   Input Parameter:
.  m - the handle, after MortiseSolve()

   Options Database Keys:
+  -output <path>            - <path>.h5, .xdmf, .json, and files of every pair
.  -output_format <xdmf,vtu> - format of the fields
-  -summary <file>           - the summary alone; - prints it

   Notes:
   Files of an earlier call are replaced. Does nothing where no option names a file.

   Level: beginner
.seealso: MortiseGetSummary(), MortiseView()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseWrite(Mortise m);

/*@
   MortiseView - Prints the lines that the program prints of a solution; before a solve, the scene.

   Collective

   Input Parameters:
+  m      - the handle, after MortiseSetFromOptions()
-  viewer - of type ascii; or NULL: standard output

   Level: beginner
.seealso: MortiseSolve(), MortiseGetSummary()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseView(Mortise m, PetscViewer viewer);

/*@
   MortiseGetSummary - All numbers of the solution as JSON, the same as the program writes.

   Collective

   Input Parameter:
.  m - the handle, after MortiseSolve()

   Output Parameter:
.  json - the same on all ranks; borrowed, until the next solve

   Level: beginner
.seealso: MortiseGetNumbers(), MortiseWrite()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetSummary(Mortise m, const char **json);

/*@
   MortiseGetNumbers - One number, or array of numbers, of the summary.

   Collective

   Input Parameters:
+  m    - the handle, after MortiseSolve()
.  path - keys of the summary, joined by '/', and places in lists, from 0: "pairs/joint/patches/0/force"
-  num  - numbers wanted: 1, or the length of the array

   Output Parameter:
.  values - array of shape [num]; NAN where the summary has null, 1 and 0 for true and false

   Level: intermediate
.seealso: MortiseGetSummary()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetNumbers(Mortise m, const char path[], PetscInt num, PetscReal values[]);

/*@
   MortiseGetPairForce - The force of a pair, and its normal part.

   Collective

   Input Parameters:
+  m    - the handle, after MortiseSolve()
-  pair - name of the pair

   Output Parameters:
+  force  - of the mortar side on the nonmortar body, array of shape [3], 0 beyond the dimension; or NULL
-  normal - integral of the pressure; or NULL

   Notes:
   In two dimensions for the thickness of the scene, axisymmetric for the whole ring. NAN without a solution.

   Level: beginner
.seealso: MortiseGetPressure(), MortiseGetNumbers()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetPairForce(Mortise m, const char pair[], PetscReal force[3], PetscReal *normal);

/*@
   MortiseGetEnergy - The energies of the solution.

   Collective

   Input Parameter:
.  m - the handle, after MortiseSolve()

   Output Parameters:
+  strain    - strain energy of all bodies, force times length; or NULL
-  potential - strain energy less the work of the loads; or NULL

   Level: beginner
.seealso: MortiseGetNumbers()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetEnergy(Mortise m, PetscReal *strain, PetscReal *potential);

/*@
   MortiseGetCertificate - The residuals of the answer in the uncondensed system.

   Not Collective

   Input Parameter:
.  m - the handle, after MortiseSolve()

   Output Parameter:
.  certificate - dimensionless; NAN where there is no solution

   Level: beginner
.seealso: MortiseGetStatus()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetCertificate(Mortise m, MortiseCertificate *certificate);

/*@
   MortiseGetDM - The mesh of all bodies.

   Not Collective

   Input Parameter:
.  m - the handle, after MortiseSetUp()

   Output Parameter:
.  dm - a DMPlex; borrowed, as long as the handle lives

   Notes:
   Its coordinates are those before -<body>_map; it has no section. Nodes: MortiseGetCoordinates().

   Level: advanced
.seealso: MortiseGetCoordinates()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetDM(Mortise m, DM *dm);

/*@
   MortiseGetCoordinates - Positions of all nodes.

   Collective

   Input Parameter:
.  m - the handle, after MortiseSetUp()

   Output Parameter:
.  x - length, dim numbers for each node, block size dim; borrowed, as long as the mesh

   Level: intermediate
.seealso: MortiseGetDisplacement()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetCoordinates(Mortise m, Vec *x);

/*@
   MortiseGetDisplacement - Displacements of all nodes.

   Not Collective

   Input Parameter:
.  m - the handle, after MortiseSolve()

   Output Parameter:
.  u - length, dim numbers per node, in the layout of MortiseGetCoordinates(); borrowed until the next solve

   Level: beginner
.seealso: MortiseGetCoordinates(), MortiseGetPressure()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetDisplacement(Mortise m, Vec *u);

/*@
   MortiseGetPressure - Contact pressures of a pair.

   Collective

   Input Parameters:
+  m    - the handle, after MortiseSolve()
-  pair - name of the pair

   Output Parameter:
.  p - force per area, one number for each node, 0 off the nonmortar side; borrowed, until the next solve

   Level: beginner
.seealso: MortiseGetGap(), MortiseGetPairStatus(), MortiseGetCoordinates()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetPressure(Mortise m, const char pair[], Vec *p);

/*@
   MortiseGetGap - Gaps of a pair that the motion has left.

   Collective

   Input Parameters:
+  m    - the handle, after MortiseSolve()
-  pair - name of the pair

   Output Parameter:
.  g - length, one number for each node, NAN where there is no constraint; borrowed, until the next solve

   Level: beginner
.seealso: MortiseGetPressure()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetGap(Mortise m, const char pair[], Vec *g);

/*@
   MortiseGetPairStatus - Status of the nodes of a pair.

   Collective

   Input Parameters:
+  m    - the handle, after MortiseSolve()
-  pair - name of the pair

   Output Parameters:
+  num    - nodes of this rank, those of its part of MortiseGetPressure()
-  status - MortiseNodeStatus, array of shape [num]; borrowed, until the next solve

   Level: intermediate
.seealso: MortiseGetPressure()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseGetPairStatus(Mortise m, const char pair[], PetscInt *num,
                                                   const PetscInt *status[]);

/*@
   MortiseDestroy - Destroys a handle and all that was borrowed from it.

   Collective

   Input Parameter:
.  m - the handle, NULL afterwards; NULL is allowed

   Notes:
   What a mistake has interrupted half way keeps its memory until the program ends.

   Level: beginner
.seealso: MortiseCreate()
@*/
MORTISE_PUBLIC PetscErrorCode MortiseDestroy(Mortise *m);

#if defined(__cplusplus)
}
#endif

#endif
