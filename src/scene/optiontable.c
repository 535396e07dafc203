/* optiontable.c -- the one table of all options: what -help prints, what is suggested for a misspelt name, what may be
   read.

   An argument is written as its form: `text`, `file`, `name`, `side` are words, `n` a whole number, `x` a real
   number, `e` a number or an expression in x and y; forms are repeated as often as the value has components. The
   choices of an option are in the order of the enum it is read into. PETSc's own options stand here too where people
   want them: the table is the user's manual. */
#include "scene/sceneoption.h"
#include <string.h>
#include <strings.h>

static const char *const titles[GROUP_COUNT] = {"Running",
                                                "The scene",
                                                "Mesh of a body",
                                                "Material of a body",
                                                "Supports and loads of a body",
                                                "Pairs of sides that meet",
                                                "Rigid obstacles instead of a mortar side",
                                                "Probes",
                                                "Results",
                                                "Studies: the same scene on several meshes",
                                                "Solving",
                                                "PETSc's own options that people ask for"};

static const OptionEntry table[] = {
    {GROUP_RUN, "-options_file", "file", "", "(none)",
     "Reads options from a file, one to a line, # begins a comment; the command line wins over files."},
    {GROUP_RUN, "-help", "", "", "(off)", "Prints this manual and ends."},
    {GROUP_RUN, "-h", "", "", "(off)", "The same as -help."},
    {GROUP_RUN, "-version", "", "", "(off)", "Prints the versions of Mortise and of PETSc, and ends."},
    {GROUP_RUN, "-options_allow_unused", "0|1", "", "0",
     "Options that nothing reads are told as a warning instead of ending the run."},

    {GROUP_SCENE, "-title", "text", "", "(empty)", "Free text that goes into every result."},
    {GROUP_SCENE, "-model", "plane_strain|plane_stress|axisymmetric|solid", "",
     "(plane_strain, or solid where bodies have three dimensions)",
     "What two dimensions stand for, or that there are three (solid). Axisymmetric: x is the radius r >= 0, y the axis "
     "z, "
     "forces and areas are those of the whole ring; nodes on the axis have no radial displacement."},
    {GROUP_SCENE, "-thickness", "x", "length", "1",
     "Thickness of the plane; forces and energies are for it. With -model plane_strain or plane_stress."},
    {GROUP_SCENE, "-bodies", "name,name,...", "", "(required)",
     "Names of the bodies. Each is the prefix of its body's options: letters, digits, underscores."},
    {GROUP_SCENE, "-pairs", "name,name,...", "", "(none)",
     "Names of the pairs of sides that may touch; each is the prefix of its pair's options."},
    {GROUP_SCENE, "-dm_refine", "n", "", "0", "Refines all bodies so many times; each time halves every edge."},
    {GROUP_SCENE, "-order", "1|2", "", "1",
     "Polynomial order of all bodies: nodes at vertices, or on edges and in quadrilaterals and hexahedra as well."},

    {GROUP_MESH, "-<body>_dm_plex_filename", "file", "", "(a box)",
     "Mesh from Gmsh (2.2 or 4.1) or another format that DMPlex reads; tried from here, then from the options file's "
     "folder."},
    {GROUP_MESH, "-<body>_mesh_region", "name", "", "(all cells)",
     "Takes only the cells of this physical group, by name or number, so that bodies may share a file."},
    {GROUP_MESH, "-<body>_dm_plex_box_faces", "n,n[,n]", "", "(a mesh file)",
     "Instead of a file: a box with so many cells along x and y, and in solids along z. Its sides are left and right "
     "(x), "
     "bottom and top (y); of solids left and right (x), front and back (y), bottom and top (z)."},
    {GROUP_MESH, "-<body>_dm_plex_box_lower", "x,y[,z]", "length", "(the origin)",
     "Corner of the box where all coordinates are smallest."},
    {GROUP_MESH, "-<body>_dm_plex_box_upper", "x,y[,z]", "length", "(1 along every axis)",
     "Corner of the box where all coordinates are largest."},
    {GROUP_MESH, "-<body>_dm_plex_simplex", "0|1", "", "1",
     "Box of triangles or tetrahedra (1, as everywhere in PETSc), or of quadrilaterals or hexahedra (0)."},
    {GROUP_MESH, "-<body>_map", "e,e[,e]", "length", "(identity)",
     "Takes a mesh point x, y, z to its position, on every level: graded boxes, rings, discs."},
    {GROUP_MESH, "-<body>_dm_refine", "n", "", "0", "Refines this body so many times, before -dm_refine refines all."},
    {GROUP_MESH, "-<body>_polygonal", "0|1", "", "0",
     "Sides in contact stay the polygons that straight edges make. Else facets that meet at less than 30 degrees are "
     "taken "
     "for one smooth side: gaps are those of the curves that nodal normals make of it, and refinement of a mesh file "
     "of "
     "first order puts new nodes on them."},
    {GROUP_MESH, "-<body>_order", "1|2", "", "(-order)", "Polynomial order of this body."},
    {GROUP_MESH, "-<body>_exact_displacement", "e,e[,e]", "length", "(not known)",
     "The exact solution in this body: the summary tells how far the computed one is from it."},

    {GROUP_MATERIAL, "-<body>_young", "e", "stress", "(required)", "Young's modulus of an isotropic body."},
    {GROUP_MATERIAL, "-<body>_poisson", "e", "", "(required)",
     "Poisson's ratio of an isotropic body, above -1 and below 0.5."},
    {GROUP_MATERIAL, "-<body>_stiffness", "e,e,e,e,e,e[,...]", "stress", "(isotropic)",
     "Instead of the two: the Hooke matrix, its upper triangle row by row in the order xx, yy, xy, with engineering "
     "shear strains. Axisymmetric: ten numbers, in the order xx (radius), yy (axis), zz (around), xy. Solids: 21 "
     "numbers, "
     "in the order xx, yy, zz, yz, xz, xy."},
    {GROUP_MATERIAL, "-<body>_material_angle", "x[,y,z]", "degrees", "(0)",
     "Turns the axes of -<body>_stiffness anticlockwise; in solids three turns, about z, the new x, the new z."},

    {GROUP_LOADS, "-<body>_body_force", "e,e[,e]", "force/volume", "(none)",
     "Force on the inside of the body, such as weight."},
    {GROUP_LOADS, "-<body>_bc_displacement", "side,side,...", "", "(none)",
     "Sides whose displacement is given. Sides are names or numbers of the mesh, several joined by +; a blank in a "
     "name "
     "is an underscore in the options that end with it."},
    {GROUP_LOADS, "-<body>_bc_displacement_<side>", "e,e[,e]", "length", "(required)",
     "The displacement of a listed side; the word free leaves a component free."},
    {GROUP_LOADS, "-<body>_bc_normal", "side,side,...", "", "(none)",
     "Flat sides that only slide: no displacement along their normal. Planes of symmetry."},
    {GROUP_LOADS, "-<body>_bc_traction", "side,side,...", "", "(none)", "Sides with a given force per area."},
    {GROUP_LOADS, "-<body>_bc_traction_<side>", "e,e[,e]", "stress", "(required)",
     "The force per area on a listed side."},
    {GROUP_LOADS, "-<body>_bc_pressure", "side,side,...", "", "(none)", "Sides with a given pressure."},
    {GROUP_LOADS, "-<body>_bc_pressure_<side>", "e", "stress", "(required)",
     "The pressure on a listed side; positive pushes into the body."},

    {GROUP_PAIRS, "-<pair>_nonmortar", "body:side", "", "(-<pair>_sides)",
     "The side that carries the contact pressure."},
    {GROUP_PAIRS, "-<pair>_mortar", "body:side", "", "(-<pair>_sides)",
     "The side it meets; or an obstacle, see below."},
    {GROUP_PAIRS, "-<pair>_sides", "body:side,body:side", "", "(none)",
     "Instead of the two: both sides, their roles chosen by stiffness and mesh."},
    {GROUP_PAIRS, "-<pair>_type", "contact|tied", "", "contact",
     "Sides that push but never pull, without friction; or sides glued together, across a gap as by rigid links."},
    {GROUP_PAIRS, "-<pair>_gap", "e", "length", "(measured)",
     "The gap between the sides, instead of the one measured from the meshes."},
    {GROUP_PAIRS, "-<pair>_gap_offset", "e", "length", "(none)",
     "Is added to the gap; negative for an interference fit."},
    {GROUP_PAIRS, "-<pair>_reach", "x", "length", "(from the meshes)",
     "How far apart facets are still taken for partners, across a gap or in an overlap. One that misses an overlap is "
     "refused, or exit code 3 where loads make it."},
    {GROUP_PAIRS, "-<pair>_multipliers", "nodes|vertices", "", "nodes",
     "On a nonmortar side of order 2: whether all its nodes carry a pressure, or its vertices alone."},
    {GROUP_PAIRS, "-<pair>_exact_pressure", "e", "stress", "(not known)",
     "The exact contact pressure: the summary tells how far the computed one is from it."},

    {GROUP_OBSTACLES, "-<pair>_obstacle", "plane|ball|circle|cylinder|parabola|expression", "", "(none)",
     "Shape of a rigid body that the nonmortar side meets. In a plane a ball is a circle, and an axisymmetric scene "
     "turns "
     "what stands in its meridian plane about the axis: an inclined plane becomes a cone, a circle off the axis a "
     "ring. "
     "A parabola in space is one of revolution."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_point", "x,y[,z]", "length", "(the origin)",
     "A point of the plane or on the cylinder's axis, the centre of the ball, the vertex of the parabola."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_normal", "x,y[,z]", "", "(required)",
     "Direction out of the plane, or out of the parabola at its vertex, towards the body; of any length."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_axis", "x,y,z", "", "(required)",
     "Direction of the cylinder's axis, of any length; in axisymmetric scenes there is only one."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_radius", "x", "length", "(required)",
     "Radius of the ball or cylinder (negative: a hollow that the body lies in), or of curvature at the parabola's "
     "vertex "
     "(negative: a valley)."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_gap", "e", "length", "(required)",
     "With -<pair>_obstacle expression: the gap at a point of the nonmortar side, along its outward normal."},

    {GROUP_PROBES, "-probes", "name,name,...", "", "(none)",
     "Points at which the summary tells displacement and stress."},
    {GROUP_PROBES, "-probe_<probe>_at", "x,y[,z]", "length", "(required)", "Where the probe is."},
    {GROUP_PROBES, "-probe_<probe>_body", "name", "", "(the only body)", "The body it is in."},

    {GROUP_OUTPUT, "-output", "path", "", "(no files)",
     "Writes <path>.h5, <path>.xdmf, <path>.json, and <path>_<pair>.csv, .h5, .xdmf for every pair."},
    {GROUP_OUTPUT, "-output_format", "xdmf|vtu", "", "xdmf", "Format of the fields; both with xdmf,vtu."},
    {GROUP_OUTPUT, "-summary", "file", "", "(with -output)", "Writes the summary alone as JSON; - prints it."},
    {GROUP_OUTPUT, "-report", "0|1", "", "0", "With -output: writes <path>.html, a page that shows all results."},
    {GROUP_OUTPUT, "-quiet", "0|1", "", "0",
     "Prints mistakes and failures alone; -summary - still prints the summary, warnings included."},
    {GROUP_OUTPUT, "-warnings", "tell|error", "", "tell",
     "Warnings are lines on stderr and in the summary; with error any of them also makes the exit code 3."},
    {GROUP_OUTPUT, "-monitor", "0|1", "", "(on a terminal)", "The progress table, even in a log file."},
    {GROUP_OUTPUT, "-scene_view", "0|1", "", "0", "Prints what was modelled, and what was left out and why."},

    {GROUP_STUDY, "-study", "uniform|adaptive", "", "(one mesh)",
     "Solves on several meshes and tells error against time and unknowns. This version has uniform: every mesh is "
     "refined once more than the one before."},
    {GROUP_STUDY, "-study_levels", "n", "", "4",
     "With -study: the number of meshes; the first is that of the scene without a study."},
    {GROUP_STUDY, "-study_orders", "1,2", "", "(-order)",
     "With -study: the polynomial orders of all bodies that are tried on every mesh, ascending."},
    {GROUP_STUDY, "-study_memory", "x[K|M|G|T]", "bytes", "(no limit)",
     "With -study: memory of all processes together; a mesh that is expected to need more is left out."},

    {GROUP_SOLVER, "-snes_type", "pdas|vinewtonrsls|vinewtonssls", "", "pdas",
     "Primal-dual active sets, or one of PETSc's solvers of inequalities on the same problem."},
    {GROUP_SOLVER, "-snes_pdas_c", "x", "", "1",
     "Constant of the active set test, in multiples of the local stiffness."},
    {GROUP_SOLVER, "-snes_pdas_start", "empty|full|gap|previous", "", "empty",
     "Active set to begin with: no node, every node, those that overlap, or that of the solve before; full by default "
     "where contact alone holds a body."},
    {GROUP_SOLVER, "-snes_pdas_reduce", "0|1", "", "(if it is cheap)",
     "Whether one factorisation serves all active sets, by a dense matrix for the nodes that may touch."},
    {GROUP_SOLVER, "-stop", "residual|discretisation", "", "residual",
     "Where to stop: at -snes_rtol, or where the solver's error in the energy norm is a tenth of the discretisation "
     "error, "
     "by what the coarser levels of the mesh say of it."},
    {GROUP_SOLVER, "-cross_check", "0|1", "", "0",
     "Solves by pdas and by vinewtonrsls and compares; a difference is exit code 3. The second one has multigrid where "
     "the "
     "first has it, and else a factorisation (-cross_check_pc_type says otherwise), and 500 iterations or twice those "
     "of "
     "the first (-cross_check_snes_max_it). If it finds nothing, that is a warning."},
    {GROUP_SOLVER, "-measure_linear", "0|1", "", "0",
     "After the solution, solves one linear system with its active set, from zero to 1e-8 and with everything the "
     "linear solver "
     "needs made anew; timing.linear_reference in the summary is what that takes, in seconds."},

    {GROUP_PETSC, "-snes_max_it", "n", "", "500",
     "Largest number of active sets to try; of iterations, 100 by default, where -snes_type is one of PETSc's."},
    {GROUP_PETSC, "-snes_rtol", "x", "", "1e-8",
     "Relative residual that pdas asks of a linear system; of the inequality, 1e-12 by default, where -snes_type is "
     "one of PETSc's."},
    {GROUP_PETSC, "-snes_monitor", "", "", "(off)", "PETSc's line for every nonlinear iteration."},
    {GROUP_PETSC, "-snes_converged_reason", "", "", "(off)", "Why the nonlinear solver ended."},
    {GROUP_PETSC, "-ksp_type", "name", "", "(by size)",
     "Linear solver: preonly for a factorisation, cg with a preconditioner."},
    {GROUP_PETSC, "-ksp_rtol", "x", "", "1e-10",
     "Relative tolerance of an iterative linear solver; a factorisation does not need it."},
    {GROUP_PETSC, "-ksp_*", "", "", "",
     "Everything else of KSP: -ksp_monitor, -ksp_view, -ksp_max_it; they show nothing where one factorisation serves "
     "all active sets (-snes_pdas_reduce 0)."},
    {GROUP_PETSC, "-pc_type", "name", "", "(by size)",
     "Preconditioner: cholesky, truncatedmg (multigrid), gamg, hypre, jacobi."},
    {GROUP_PETSC, "-pc_*", "", "", "", "Everything else of PC: -pc_factor_mat_solver_type, -pc_gamg_threshold."},
    {GROUP_PETSC, "-mat_mumps_*", "", "", "", "Controls of MUMPS: -mat_mumps_icntl_14 (spare memory, percent)."},
    {GROUP_PETSC, "-log_view", "", "", "(off)", "PETSc's table of times and flops by stage and event."},
    {GROUP_PETSC, "-info", "", "", "(off)", "PETSc tells what it decides."},
    {GROUP_PETSC, "-malloc_dump", "", "", "(off)", "Lists memory that was not freed."},
};

const OptionEntry *OptionTable(PetscInt *num_entries)
{
  *num_entries = (PetscInt)(sizeof(table) / sizeof(table[0]));
  return table;
}

const char *OptionGroupTitle(OptionGroup group)
{
  return titles[group];
}

OptionScope OptionEntryScope(const OptionEntry *entry)
{
  if (strstr(entry->name, "<body>")) return SCOPE_BODY;
  if (strstr(entry->name, "<pair>")) return SCOPE_PAIR;
  if (strstr(entry->name, "<probe>")) return SCOPE_PROBE;
  return SCOPE_PROGRAM;
}

/* Whether an option fits a pattern with this owner and anything for <side> or '*'. Like PETSc's database it does not
   tell capitals from small letters. */
static PetscBool OptionFits_Private(const char pattern[], const char owner[], const char option[])
{
  while (*pattern) {
    if (*pattern == '*' || !strncmp(pattern, "<side>", 6)) return (PetscBool)(*option != '\0');
    if (*pattern == '<') {
      const size_t length = strlen(owner);

      if (strncasecmp(owner, option, length) != 0) return PETSC_FALSE;
      option += length;
      pattern = strchr(pattern, '>') + 1;
    } else if (strncasecmp(pattern++, option++, 1) != 0)
      return PETSC_FALSE;
  }
  return (PetscBool)(*option == '\0');
}

const OptionEntry *OptionTableMatch(OptionScope scope, const char owner[], const char option[])
{
  for (size_t i = 0; i < sizeof(table) / sizeof(table[0]); i++) {
    if (OptionEntryScope(&table[i]) == scope && OptionFits_Private(table[i].name, owner, option)) return &table[i];
  }
  return NULL;
}
