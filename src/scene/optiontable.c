/* optiontable.c -- the one table of all options: what -help prints, what is suggested for a misspelt name,
   what may be read.

   An argument is written as its form. `text`, `file`, `name`, `side` are words, `n` is a whole number, `x` a
   real number, `e` a number or a formula. Forms are repeated as often as the value has
   components. The choices of an option are in the order of its enum. The table is the user's manual, so it
   has the common options of PETSc. */
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
                                                "Probes and paths",
                                                "Results",
                                                "Adaptive meshes and error bars",
                                                "Studies: the same scene on several meshes",
                                                "Load steps: the same scene at several times",
                                                "Solving",
                                                "PETSc's own options, the common ones"};

static const OptionEntry table[] = {
    {GROUP_RUN, "-options_file", "file", "", "(none)",
     "Reads options from a file, one per line; # begins a comment. The command line overrides files."},
    {GROUP_RUN, "-options_file_yaml", "file", "", "(none)", "Reads options from a YAML file, by PETSc."},
    {GROUP_RUN, "-options_string", "text", "", "(none)",
     "Options in one text, \"-upper_young 3e5 -order 2\", as in an options file."},
    {GROUP_RUN, "-options_string_yaml", "text", "", "(none)",
     "Options as YAML in one text, \"{upper_young: 3e5, order: 2}\", by PETSc."},
    {GROUP_RUN, "-prefix_push", "prefix", "", "(none)",
     "Begins the names of the options that follow, as far as -prefix_pop; by PETSc."},
    {GROUP_RUN, "-prefix_pop", "", "", "", "Takes the last prefix back."},
    {GROUP_RUN, "-help", "", "", "(off)", "Prints this manual and ends."},
    {GROUP_RUN, "-h", "", "", "(off)", "The same as -help."},
    {GROUP_RUN, "-version", "", "", "(off)", "Prints the versions of Mortise and of PETSc, and ends."},
    {GROUP_RUN, "-convert", "file.msh file.h5", "", "(none)",
     "Makes of a Gmsh file an HDF5 mesh, which is read faster, and by each rank in part, and ends. A file that exists "
     "is "
     "not replaced."},
    {GROUP_RUN, "-options_allow_unused", "0|1", "", "0",
     "Options that nothing reads give a warning instead of ending the run."},

    {GROUP_SCENE, "-title", "text", "", "(empty)", "Free text that goes into every result."},
    {GROUP_SCENE, "-units", "length,force,stress,temperature", "", "(no units)",
     "Names of the units in which the numbers are, such as mm,N,MPa or mm,N,MPa,K: they label plots and pages. "
     "Nothing is "
     "converted."},
    {GROUP_SCENE, "-model", "plane_strain|plane_stress|axisymmetric|solid", "",
     "(plane_strain, or solid where bodies have three dimensions)",
     "Meaning of the two dimensions, or three dimensions (solid). Axisymmetric: x is the radius r >= 0 and y the axis "
     "z. Forces and areas are those of the whole ring; nodes on the axis have no radial displacement."},
    {GROUP_SCENE, "-thickness", "x", "length", "1",
     "Thickness of the plane; forces and energies refer to it. With -model plane_strain or plane_stress."},
    {GROUP_SCENE, "-bodies", "name,name,...", "", "(required)",
     "Names of the bodies: letters, digits, underscores. Each is the prefix of the options of its body."},
    {GROUP_SCENE, "-pairs", "name,name,...", "", "(none)",
     "Names of the pairs of sides that may touch. Each is the prefix of the options of its pair."},
    {GROUP_SCENE, "-dm_refine", "n", "", "0", "Number of refinements of all bodies; each halves every edge."},
    {GROUP_SCENE, "-order", "1|2", "", "1",
     "Polynomial order of all bodies: nodes at vertices (1), or also on edges, in quadrilaterals and in hexahedra "
     "(2)."},

    {GROUP_MESH, "-<body>_dm_plex_filename", "file", "", "(a box)",
     "Mesh from Gmsh (2.2 or 4.1), an HDF5 mesh that -convert made of one, or another format that DMPlex reads. The "
     "path is relative to the working directory, else to the folder of the options file."},
    {GROUP_MESH, "-<body>_mesh_region", "name", "", "(all cells)",
     "Takes only the cells of this physical group, by name or number; + joins several. Several bodies may share a "
     "file."},
    {GROUP_MESH, "-<body>_dm_plex_box_faces", "n,n[,n]", "", "(a mesh file)",
     "Instead of a file: a box with this number of cells along x and y, and in solids along z. Its sides are left and "
     "right (x), bottom and top (y); in solids left and right (x), front and back (y), bottom and top (z)."},
    {GROUP_MESH, "-<body>_dm_plex_box_lower", "x,y[,z]", "length", "(the origin)",
     "Corner of the box with the smallest coordinates."},
    {GROUP_MESH, "-<body>_dm_plex_box_upper", "x,y[,z]", "length", "(1 along every axis)",
     "Corner of the box with the largest coordinates."},
    {GROUP_MESH, "-<body>_dm_plex_simplex", "0|1", "", "1",
     "Box of triangles or tetrahedra (1, the default of PETSc), or of quadrilaterals or hexahedra (0)."},
    {GROUP_MESH, "-<body>_map", "e,e[,e]", "length", "(identity)",
     "Position of the mesh point x, y, z, on every level: graded boxes, rings, discs."},
    {GROUP_MESH, "-<body>_dm_refine", "n", "", "0",
     "Number of refinements of this body, before those of -dm_refine. In scenes with mesh files, those that all bodies "
     "have make levels, as -dm_refine does."},
    {GROUP_MESH, "-<body>_polygonal", "0|1", "", "0",
     "Keeps the polygons of straight edges in contact. By default, facets that meet at less than 31 degrees are one "
     "smooth side. Its gaps are those of the curves that nodal normals define. Refinement of a mesh file puts new "
     "nodes on these curves; of second order, where its middle nodes are on them."},
    {GROUP_MESH, "-<body>_order", "1|2", "", "(-order)", "Polynomial order of this body."},
    {GROUP_MESH, "-<body>_exact_displacement", "e,e[,e]", "length", "(not known)",
     "Exact solution in this body; the summary has the error of the computed one."},

    {GROUP_MATERIAL, "-<body>_young", "e", "stress", "(required)", "Young's modulus of an isotropic body."},
    {GROUP_MATERIAL, "-<body>_poisson", "e", "", "(required)",
     "Poisson's ratio of an isotropic body, above -1 and below 0.5."},
    {GROUP_MATERIAL, "-<body>_stiffness", "e,e,e,e,e,e[,...]", "stress", "(isotropic)",
     "Instead of the two: the Hooke matrix, its upper triangle row by row in the order xx, yy, xy, with engineering "
     "shear strains. Axisymmetric: ten numbers in the order xx (radius), yy (axis), zz (around), xy. Solids: 21 "
     "numbers in the order xx, yy, zz, yz, xz, xy."},
    {GROUP_MATERIAL, "-<body>_material_angle", "x[,y,z]", "degrees", "(0)",
     "Rotation of the axes of -<body>_stiffness and of three coefficients of thermal expansion, anticlockwise; in "
     "solids three rotations, about z, the new x, the new z."},
    {GROUP_MATERIAL, "-<body>_thermal_expansion", "e[,e,e]", "1/temperature", "(none)",
     "Coefficient of thermal expansion; three numbers are those of the axes of the material: x, y, z, or radius, axis, "
     "around. Wants -<body>_temperature."},
    {GROUP_MATERIAL, "-<body>_regions", "name,name,...", "", "(one material)",
     "Physical groups of the mesh file, by name or number, with materials of their own; + joins several. A region has "
     "the values of its "
     "body where it gives none; so have cells in no region. A space in a name is an underscore in the options below."},
    {GROUP_MATERIAL, "-<body>_<region>_young", "e", "stress", "(that of the body)", "Young's modulus of a region."},
    {GROUP_MATERIAL, "-<body>_<region>_poisson", "e", "", "(that of the body)", "Poisson's ratio of a region."},
    {GROUP_MATERIAL, "-<body>_<region>_stiffness", "e,e,e,e,e,e[,...]", "stress", "(that of the body)",
     "Instead of the two: the Hooke matrix of a region, as of a body."},
    {GROUP_MATERIAL, "-<body>_<region>_material_angle", "x[,y,z]", "degrees", "(that of the body)",
     "Rotation of the axes of the material in a region, as of a body."},
    {GROUP_MATERIAL, "-<body>_<region>_thermal_expansion", "e[,e,e]", "1/temperature", "(that of the body)",
     "Coefficient of thermal expansion of a region, as of a body. Wants a temperature of the region or of its body."},

    {GROUP_LOADS, "-<body>_body_force", "e,e[,e]", "force/volume", "(none)", "Force per volume, such as weight."},
    {GROUP_LOADS, "-<body>_bc_displacement", "side,side,...", "", "(none)",
     "Sides with a given displacement. Sides are names or numbers of the mesh; + joins several. A space in a name is "
     "an underscore in the options that end with it."},
    {GROUP_LOADS, "-<body>_bc_displacement_<side>", "e,e[,e]", "length", "(required)",
     "Displacement of a listed side; the word free leaves a component free."},
    {GROUP_LOADS, "-<body>_bc_normal", "side,side,...", "", "(none)",
     "Flat sides without displacement along their normal, such as planes of symmetry."},
    {GROUP_LOADS, "-<body>_bc_traction", "side,side,...", "", "(none)", "Sides with a given force per area."},
    {GROUP_LOADS, "-<body>_bc_traction_<side>", "e,e[,e]", "stress", "(required)", "Force per area on a listed side."},
    {GROUP_LOADS, "-<body>_bc_pressure", "side,side,...", "", "(none)", "Sides with a given pressure."},
    {GROUP_LOADS, "-<body>_bc_pressure_<side>", "e", "stress", "(required)",
     "Pressure on a listed side; positive pushes into the body."},
    {GROUP_LOADS, "-<body>_bc_force", "side,side,...", "", "(none)",
     "Sides with a given total force, which is spread as a uniform force per area. The summary has the sums as loads."},
    {GROUP_LOADS, "-<body>_bc_force_<side>", "e,e[,e]", "force", "(required)",
     "Total force on a listed side, for the whole thickness; axisymmetric: sums of the radial and axial components "
     "over "
     "the whole ring. Numbers, or formulas of t."},
    {GROUP_LOADS, "-<body>_bc_moment", "side,side,...", "", "(none)",
     "Sides with a given total moment about their centroid. It is spread as a force per area that is linear in "
     "position and has no resultant. Not axisymmetric."},
    {GROUP_LOADS, "-<body>_bc_moment_<side>", "e[,e,e]", "force*length", "(required)",
     "Total moment on a listed side: about z, anticlockwise, for the whole thickness; in solids three components. "
     "Numbers, or formulas of t."},
    {GROUP_LOADS, "-<body>_temperature", "e", "temperature", "(none)",
     "Temperature above that of the body without stress. Wants -<body>_thermal_expansion."},
    {GROUP_LOADS, "-<body>_initial_strain", "e,e,e,e[,e,e]", "", "(none)",
     "Strain that the body has without stress: xx, yy, zz, xy; in solids xx, yy, zz, yz, xz, xy. Shear strains are "
     "engineering shear strains. Axisymmetric: x is the radius, y the axis, z around."},
    {GROUP_LOADS, "-<body>_<region>_body_force", "e,e[,e]", "force/volume", "(that of the body)",
     "Force per volume in a region, such as the weight of another density."},
    {GROUP_LOADS, "-<body>_<region>_temperature", "e", "temperature", "(that of the body)",
     "Temperature of a region above that without stress."},
    {GROUP_LOADS, "-<body>_<region>_initial_strain", "e,e,e,e[,e,e]", "", "(that of the body)",
     "Strain that a region has without stress, as of a body."},
    {GROUP_LOADS, "-<body>_pretension", "e", "force", "(none)",
     "Mean axial force in the sections of the body, above 0, as of a bolt that is tightened; found as a strain along "
     "the "
     "axis. With -load_steps the strain of the first step is kept, unless the force names t."},
    {GROUP_LOADS, "-<body>_pretension_axis", "x,y[,z]", "", "(required)",
     "With -<body>_pretension: direction of the axis, of any length. Axisymmetric: 0,1."},

    {GROUP_PAIRS, "-<pair>_nonmortar", "body:side", "", "(-<pair>_sides)", "Side that carries the contact pressure."},
    {GROUP_PAIRS, "-<pair>_mortar", "body:side", "", "(-<pair>_sides)",
     "Side opposite to it; or give an obstacle, see below."},
    {GROUP_PAIRS, "-<pair>_sides", "body:side,body:side", "", "(none)",
     "Instead of the two: both sides; stiffness and mesh decide which is nonmortar."},
    {GROUP_PAIRS, "-<pair>_type", "contact|tied", "", "contact",
     "Contact: sides push but never pull. Tied: sides are glued together, across a gap as by rigid "
     "links."},
    {GROUP_PAIRS, "-<pair>_gap", "e", "length", "(measured)",
     "Gap between the sides, instead of the one measured from the meshes."},
    {GROUP_PAIRS, "-<pair>_gap_offset", "e", "length", "(none)", "Added to the gap; negative for an interference fit."},
    {GROUP_PAIRS, "-<pair>_friction", "e", "", "0",
     "Coulomb's coefficient of friction: the tangential traction is at most this times the pressure, and opposes the "
     "slip of the load step. 0 is contact without friction."},
    {GROUP_PAIRS, "-<pair>_friction_bound", "e", "stress", "0",
     "Instead of it, Tresca's friction: the greatest tangential traction, whatever the pressure, also where the sides "
     "are apart."},
    {GROUP_PAIRS, "-<pair>_reach", "x", "length", "(from the meshes)",
     "Largest distance between facets that may be partners, across a gap or in an overlap. One below an initial "
     "overlap is refused; one below an overlap that loads make gives exit code 3."},
    {GROUP_PAIRS, "-<pair>_allow_empty", "0|1", "", "0",
     "No part of the nonmortar side need face its partner: a warning takes the place of exit code 1. For sides that "
     "meet under other loads only."},
    {GROUP_PAIRS, "-<pair>_multipliers", "nodes|vertices", "", "nodes",
     "On a nonmortar side of order 2: all nodes carry a pressure, or the vertices alone."},
    {GROUP_PAIRS, "-<pair>_exact_pressure", "e", "stress", "(not known)",
     "Exact contact pressure; the summary has the error of the computed one."},

    {GROUP_OBSTACLES, "-<pair>_obstacle", "plane|ball|circle|cylinder|parabola|expression", "", "(none)",
     "Shape of a rigid body opposite to the nonmortar side. In a plane a ball is a circle. An axisymmetric scene "
     "rotates the section about the axis: an inclined plane becomes a cone, a circle off the axis a ring. A parabola "
     "in space is one of revolution."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_point", "x,y[,z]", "length", "(the origin)",
     "A point of the plane or on the cylinder's axis, the centre of the ball, the vertex of the parabola."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_normal", "x,y[,z]", "", "(required)",
     "Direction out of the plane, or out of the parabola at its vertex, towards the body, of any length."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_axis", "x,y,z", "", "(required)",
     "Direction of the cylinder's axis, of any length; an axisymmetric scene has only one axis."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_radius", "x", "length", "(required)",
     "Radius of the ball or cylinder (negative: a hollow around the body), or of curvature at the parabola's vertex "
     "(negative: a valley)."},
    {GROUP_OBSTACLES, "-<pair>_obstacle_gap", "e", "length", "(required)",
     "With -<pair>_obstacle expression: gap at a point of the nonmortar side, along its outward normal."},

    {GROUP_PROBES, "-probes", "name,name,...", "", "(none)",
     "Points at which the summary has displacement and stress."},
    {GROUP_PROBES, "-probe_<probe>_at", "x,y[,z]", "length", "(required)", "Position of the probe."},
    {GROUP_PROBES, "-probe_<probe>_body", "name", "", "(the only body)", "Body of the probe."},
    {GROUP_PROBES, "-paths", "name,name,...", "", "(none)",
     "Straight lines along which <output>_paths.csv has displacement and stress; points outside the body have empty "
     "cells."},
    {GROUP_PROBES, "-path_<path>_from", "x,y[,z]", "length", "(required)", "Begin of the path."},
    {GROUP_PROBES, "-path_<path>_to", "x,y[,z]", "length", "(required)", "End of the path."},
    {GROUP_PROBES, "-path_<path>_points", "n", "", "51", "Number of points, ends included."},
    {GROUP_PROBES, "-path_<path>_body", "name", "", "(the only body)", "Body of the path."},

    {GROUP_OUTPUT, "-output", "path", "", "(no files)",
     "Writes <path>.h5, <path>.xdmf, <path>.json, and <path>_<pair>.csv, .h5, .xdmf for every pair."},
    {GROUP_OUTPUT, "-output_format", "xdmf|vtu", "", "xdmf", "Format of the fields; both with xdmf,vtu."},
    {GROUP_OUTPUT, "-summary", "file", "", "(with -output)", "Writes the summary alone as JSON; - prints it."},
    {GROUP_OUTPUT, "-report", "0|1", "", "0", "With -output: writes <path>.html, a page with all results."},
    {GROUP_OUTPUT, "-quiet", "0|1", "", "0",
     "Prints mistakes and failures alone; -summary - still prints the summary, with its warnings."},
    {GROUP_OUTPUT, "-warnings", "tell|error", "", "tell",
     "Warnings are lines on stderr and entries of the summary; with error, any warning also makes the exit code 3."},
    {GROUP_OUTPUT, "-warnings_accept", "code,...", "", "(none)",
     "Codes of warnings that are expected, such as mixed_units for steel on rubber: they have no line and do not fail "
     "the run, and the summary marks them as accepted."},
    {GROUP_OUTPUT, "-check", "0|1", "", "0",
     "Reads, meshes and checks the scene without solving it: tables of bodies, sides, pairs and loads, also in the "
     "summary, and with -output a file of the undeformed bodies. Of a study, the first mesh; of load steps, t = 1."},
    {GROUP_OUTPUT, "-monitor", "0|1", "", "(on a terminal)", "Prints the progress table, also into a file."},
    {GROUP_OUTPUT, "-scene_view", "0|1", "", "0", "Prints the model, and what was omitted and why."},

    {GROUP_ADAPT, "-adapt", "x", "", "(the mesh as it is)",
     "Refines where the estimated error is large, until it is at most this part of the solution in the energy norm, "
     "such as 1e-2 or 1e-3. Results have error bars. Bodies have -order 2 unless the scene says otherwise; "
     "quadrilaterals and hexahedra are cut into triangles and tetrahedra, unless -adapt_cells keeps them."},
    {GROUP_ADAPT, "-adapt_cells", "simplices|kept", "", "simplices",
     "With -adapt, -adapt_goal or -study adaptive: whether quadrilaterals and hexahedra are cut into triangles and "
     "tetrahedra, or kept and split into four and eight, with nodes that hang on the edges and faces of larger ones. "
     "Bodies that have other cells as well are cut."},
    {GROUP_ADAPT, "-adapt_goal", "force:<pair>|probe:<name>|pressure:<pair>, ...", "", "(the energy norm)",
     "Refines for these numbers, with or without -adapt: the normal force of a pair, von Mises' stress at a probe, the "
     "largest pressure of a pair. Refinement ends when their error bars are small enough."},
    {GROUP_ADAPT, "-adapt_goal_tolerance", "x", "", "1e-2",
     "With -adapt_goal: the error bar that is asked for, as a part of the number."},
    {GROUP_ADAPT, "-adapt_marking", "x", "", "0.5",
     "With -adapt or -adapt_goal: cells with the largest errors are refined, as many as hold this part of the squared "
     "error."},
    {GROUP_ADAPT, "-adapt_max_unknowns", "x", "", "1e6",
     "With -adapt or -adapt_goal: no mesh with more unknowns is begun. Where that ends the search before the "
     "tolerance, results and "
     "bars are written and the exit code is 3."},
    {GROUP_ADAPT, "-adapt_max_meshes", "n", "", "40",
     "With -adapt or -adapt_goal: the largest number of meshes, with the same end."},

    {GROUP_STUDY, "-study", "uniform|adaptive", "", "(one mesh)",
     "Solves on several meshes and compares error, time and unknowns. Each mesh is refined once more than the one "
     "before: "
     "every cell (uniform), or where the estimated error is large, as with -adapt (adaptive, of one order)."},
    {GROUP_STUDY, "-study_levels", "n", "", "4",
     "With -study: number of meshes, adaptive 12 by default; the first is that of the scene without a study."},
    {GROUP_STUDY, "-study_orders", "1,2", "", "(-order)",
     "With -study: polynomial orders of all bodies, each solved on every mesh, ascending."},
    {GROUP_STUDY, "-study_memory", "x[K|M|G|T]", "bytes", "(no limit)",
     "With -study, -adapt or -adapt_goal: memory of all processes together; a mesh that is expected to need more is "
     "omitted."},

    {GROUP_STEPS, "-load_steps", "n or t,t,...", "", "(one solution, t = 1)",
     "Solves at several times t, each from the solution before: n equal steps up to 1, or a list of times. Every "
     "formula "
     "may name t."},
    {GROUP_STEPS, "-restart", "file.h5", "", "(bodies without loads)",
     "Goes on from the last solved step of an earlier run of the scene, which may have had another number of ranks. "
     "Slip of friction counts from there. Where -load_steps begins with all times that were solved, these are omitted; "
     "of a number of steps, those up to the last time."},
    {GROUP_STEPS, "-load_steps_halved", "0|1", "", "0",
     "Solves all load steps three times, whole, in two parts and in four. Results are those of four parts, with the "
     "limits for ever smaller "
     "steps and their uncertainty; for friction, whose results depend on the steps."},
    {GROUP_STEPS, "-load_steps_scale", "none|loads|displacements|gaps|temperatures", "",
     "(all, where no datum names t; else none)",
     "What t multiplies: one or several of these, separated by commas. Data that name t are not multiplied."},

    {GROUP_SOLVER, "-snes_type", "pdas|vinewtonrsls|vinewtonssls", "", "pdas",
     "Primal-dual active set method, or one of PETSc's solvers of inequalities on the same problem."},
    {GROUP_SOLVER, "-snes_pdas_c", "x", "", "1",
     "Constant of the active set test, in multiples of the local stiffness."},
    {GROUP_SOLVER, "-snes_pdas_start", "empty|full|gap|previous", "", "empty",
     "Initial active set: no node, every node, nodes that overlap, or that of the previous solve; full by default if "
     "contact alone supports a body."},
    {GROUP_SOLVER, "-snes_pdas_reduce", "0|1", "", "(if it is cheap)",
     "One factorization for all active sets, with a dense matrix for the nodes that may touch."},
    {GROUP_SOLVER, "-stop", "residual|discretisation", "", "residual",
     "Stopping criterion: -snes_rtol, or an error of the solver of a tenth of the discretisation error, in the energy "
     "norm. The coarser levels of the mesh give the latter."},
    {GROUP_SOLVER, "-cross_check", "0|1", "", "0",
     "Solves with pdas and with vinewtonrsls and compares; a difference gives exit code 3. The second solver uses "
     "multigrid if the first does, else a factorization (or -cross_check_pc_type). It has 500 iterations or twice "
     "those of the first (or -cross_check_snes_max_it). A warning tells if it does not converge."},
    {GROUP_SOLVER, "-measure_linear", "0|1", "", "0",
     "After the solution, solves one linear system with its active set, from zero to 1e-8, with a new setup of the "
     "linear solver. The summary has the seconds as timing.linear_reference."},
    {GROUP_SOLVER, "-infsup", "0|1", "", "0",
     "After the solution, computes the discrete inf-sup number of each pair and the condition number of its Schur "
     "complement: pairs.<pair>.inf_sup. One factorization and a dense eigenvalue problem for each pair, of at most "
     "3000 "
     "multipliers."},

    {GROUP_PETSC, "-snes_max_it", "n", "", "500",
     "Largest number of active sets; with another -snes_type of iterations, 100 by default."},
    {GROUP_PETSC, "-snes_rtol", "x", "", "1e-8",
     "Relative residual of a linear system of pdas; with another -snes_type of the inequality, 1e-12 by default."},
    {GROUP_PETSC, "-snes_monitor", "", "", "(off)", "PETSc's line for every nonlinear iteration."},
    {GROUP_PETSC, "-snes_converged_reason", "", "", "(off)", "Prints why the nonlinear solver ended."},
    {GROUP_PETSC, "-ksp_type", "name", "", "(by size)",
     "Linear solver: preonly for a factorization, cg with a preconditioner."},
    {GROUP_PETSC, "-ksp_rtol", "x", "", "1e-10",
     "Relative tolerance of an iterative linear solver; a factorization does not need it."},
    {GROUP_PETSC, "-ksp_*", "", "", "",
     "All other options of KSP: -ksp_monitor, -ksp_view, -ksp_converged_reason, -ksp_max_it. If one of those that "
     "print is "
     "given, every active set has its own factorization, as with -snes_pdas_reduce 0."},
    {GROUP_PETSC, "-pc_type", "name", "", "(by size)",
     "Preconditioner: cholesky, truncatedmg (multigrid), gamg, hypre, jacobi."},
    {GROUP_PETSC, "-pc_*", "", "", "", "All other options of PC: -pc_factor_mat_solver_type, -pc_gamg_threshold."},
    {GROUP_PETSC, "-mat_mumps_*", "", "", "", "Controls of MUMPS: -mat_mumps_icntl_14 (spare memory, percent)."},
    {GROUP_PETSC, "-log_view", "", "", "(off)", "PETSc's table of times and flops by stage and event."},
    {GROUP_PETSC, "-info", "", "", "(off)", "Prints the decisions of PETSc and of Mortise."},
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
  if (strstr(entry->name, "<region>")) return SCOPE_REGION;
  if (strstr(entry->name, "<body>")) return SCOPE_BODY;
  if (strstr(entry->name, "<pair>")) return SCOPE_PAIR;
  if (strstr(entry->name, "<probe>")) return SCOPE_PROBE;
  if (strstr(entry->name, "<path>")) return SCOPE_PATH;
  return SCOPE_PROGRAM;
}

const char *OptionPlaceholderEnd(const char pattern[])
{
  static const char region[] = "_<region>";
  const char       *end      = strchr(pattern, '>') + 1;

  return strncmp(end, region, strlen(region)) ? end : end + strlen(region);
}

/* Whether an option fits a pattern with this owner and anything for <side> or '*'. Like PETSc's database it
   does not tell capitals from small letters. */
static PetscBool OptionFits_Private(const char pattern[], const char owner[], const char option[])
{
  while (*pattern) {
    if (*pattern == '*' || !strncmp(pattern, "<side>", 6)) return (PetscBool)(*option != '\0');
    if (*pattern == '<') {
      const size_t length = strlen(owner);

      if (strncasecmp(owner, option, length) != 0) return PETSC_FALSE;
      option += length;
      pattern = OptionPlaceholderEnd(pattern);
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
