/* scene.h -- the options as plain data, checked as far as possible without a mesh.

   Plain data. Absent things are NULL or of zero length. All texts and expressions are owned by the scene. */
#ifndef MORTISE_SCENE_H
#define MORTISE_SCENE_H

#include <petscsys.h>
#include <stdio.h>
#include "base/expression.h"
#include "kernel/material.h"

typedef enum {
  BOUNDARY_DISPLACEMENT,
  BOUNDARY_NORMAL,
  BOUNDARY_TRACTION,
  BOUNDARY_PRESSURE,
  BOUNDARY_FORCE, /* total force, spread as a uniform traction [dim] */
  BOUNDARY_MOMENT /* total moment about the centroid, spread as a linear traction [1, in space 3] */
} BoundaryKind;

/* Data on one side of a body. */
typedef struct {
  BoundaryKind kind;
  char        *side; /* as typed: a name, a number, or several joined with '+' */
  Expression
      value; /* displacement [dim] with free components, traction [dim], pressure [1]; NULL for BOUNDARY_NORMAL */
} SceneBoundary;

/* The material of cells, and the data that act inside them. */
typedef struct {
  Expression young, poisson; /* isotropic, else NULL */
  Expression stiffness;      /* upper triangle of the Hooke tensor, else NULL */
  PetscReal  angle[3];       /* of the material axes, degrees */
  Expression body_force;     /* force per volume [dim], or NULL */
  Expression temperature;    /* above that without stress [1], or NULL as expansion */
  Expression expansion;      /* thermal: of all directions [1], of the material axes [3] */
  Expression initial_strain; /* without stress [4, in space 6], or NULL */
} SceneMaterial;

/* A part of a body with a material of its own. Data that its options do not give are those of the body. */
typedef struct {
  PetscInt      body;
  char         *group;  /* physical group of the mesh file: name or number */
  char         *prefix; /* of its options, without the underscore: <body>_<region> */
  SceneMaterial material;
} SceneRegion;

typedef struct {
  char         *name;      /* also the option prefix, without the underscore */
  char         *mesh_file; /* found path of a mesh, or NULL for a box */
  char         *region;    /* physical groups (name or number) of the cells, joined with '+', or NULL for all */
  PetscBool     simplex;   /* box of triangles (tetrahedra) instead of quads (hexes) */
  PetscInt      faces[3];  /* cells of the box along each axis */
  PetscReal     lower[3], upper[3];
  Expression    map;    /* box coordinates to positions [dim], or NULL */
  PetscInt      refine; /* refinements of this body, before those of all */
  PetscInt      order;
  PetscBool     polygonal;                 /* sides are the polygons that the facets of first order make */
  PetscBool     curved_file;               /* set by the mesh: the file is of second order */
  PetscBool     straightened;              /* likewise: it has curved sides, of which order 1 makes chords */
  PetscBool     arcs;                      /* likewise: it has sides of pairs that are taken for smooth and bend */
  PetscInt      num_nonmanifold;           /* likewise, on the first rank: vertices that alone connect some cells */
  PetscReal     nonmanifold[3];            /* the first of them, before the map */
  SceneMaterial material;                  /* of the cells in no region */
  PetscInt      first_region, num_regions; /* of scene->regions; 0 where all cells have the material above */
  char      *missing; /* with regions: the missing option without which cells in no region have no material, or NULL */
  Expression pretension; /* mean axial force [1], or NULL */
  PetscReal  axis[3];    /* of the pretension, unit */
  PetscReal  tightening; /* its strain along the axis, found by the solution */
  Expression exact;      /* the exact displacement, where it is known [dim], or NULL */
  PetscInt   num_boundaries;
  SceneBoundary *boundaries; /* in the order typed: displacement, normal, traction, pressure, force, moment */
} SceneBody;

typedef enum { PAIR_CONTACT, PAIR_TIED } PairType;
/* Which nodes of a nonmortar side of second order carry multipliers. */
typedef enum { MULTIPLIERS_NODES, MULTIPLIERS_VERTICES } PairMultipliers;
typedef enum {
  OBSTACLE_NONE,
  OBSTACLE_PLANE,
  OBSTACLE_BALL,
  OBSTACLE_CYLINDER,
  OBSTACLE_PARABOLA,
  OBSTACLE_EXPRESSION
} ObstacleKind;

/* A rigid body without a mesh. */
typedef struct {
  ObstacleKind kind;
  PetscReal    point[3];  /* on the plane, on the cylinder's axis; centre of the ball; vertex of the parabola */
  PetscReal    normal[3]; /* unit, out of the obstacle, towards the body: of the plane, of the parabola at its vertex */
  PetscReal    axis[3];   /* of the cylinder, unit */
  PetscReal
      radius; /* of ball and cylinder (negative: a hollow the body lies in), of curvature at the parabola's vertex */
  Expression gap; /* OBSTACLE_EXPRESSION: the gap itself, a function of the nonmortar point [1] */
} SceneObstacle;

typedef struct {
  PetscInt body; /* index into bodies, or -1 */
  char    *side;
} SceneSide;

typedef struct {
  char           *name;
  PairType        type;
  PetscBool       roles_open; /* the user gave -<pair>_sides only: the mesh decides which side is nonmortar */
  SceneSide       nonmortar;
  SceneSide       mortar;      /* body = -1 with an obstacle */
  SceneObstacle   obstacle;    /* kind OBSTACLE_NONE with a meshed mortar side */
  Expression      gap;         /* replaces the measured gap, or NULL [1] */
  Expression      gap_offset;  /* is added to it, or NULL [1] */
  Expression      friction;    /* Coulomb's coefficient, or NULL without friction [1] */
  Expression      bound;       /* greatest tangential traction that does not depend on the pressure, or NULL [1] */
  PetscReal       reach;       /* farthest candidate, or negative: from the geometry */
  PetscBool       widened;     /* whether the reach was set after a solution that moved farther, not by the user */
  PetscBool       allow_empty; /* it is no mistake if nothing of the nonmortar side faces the partner */
  PairMultipliers multipliers;
  Expression      exact; /* the exact pressure, where it is known [1], or NULL */
} ScenePair;

typedef struct {
  char     *name;
  PetscInt  body;
  PetscReal at[3];
} SceneProbe;

/* A straight line at whose points, evenly spaced, ends included, results are evaluated. */
typedef struct {
  char     *name;
  PetscInt  body, points;
  PetscReal from[3], to[3];
} ScenePath;

/* [out] at - [3]; the i-th point of a path */
static inline void ScenePathGetPoint(const ScenePath *path, PetscInt i, PetscReal at[3])
{
  const PetscReal share = (PetscReal)i / (PetscReal)(path->points - 1);

  for (PetscInt k = 0; k < 3; k++)
    at[k] = i == path->points - 1 ? path->to[k] : path->from[k] + share * (path->to[k] - path->from[k]);
}

typedef enum { OUTPUT_XDMF = 1, OUTPUT_VTU = 2 } OutputFormat; /* bits */

typedef enum { STUDY_NONE, STUDY_UNIFORM, STUDY_ADAPTIVE } StudyKind;
enum {
  STUDY_MAX_ORDERS = 2,
  STUDY_OWN_ORDERS = 0 /* in place of an order: every body keeps its own, and they differ */
};

/* Whether linear systems are solved with the help of coarser meshes, as far as -ksp_type and -pc_type say. */
/* The stopping criterion of iterative solvers. */
typedef enum { STOP_RESIDUAL, STOP_DISCRETISATION } SceneStop;

typedef enum { LEVELS_BY_SIZE, LEVELS_USED, LEVELS_UNUSED } SceneLevels;

/* The same scene on several meshes. */
typedef struct {
  StudyKind kind;
  PetscInt
      levels; /* meshes, each refined once more than the one before, or where the error is; the first is the scene's own */
  PetscInt  num_orders, orders[STUDY_MAX_ORDERS]; /* of all bodies, ascending; STUDY_OWN_ORDERS only alone */
  PetscReal memory; /* bytes that a run may take, of all ranks together; infinite where nothing was said */
} SceneStudy;

/* What changes with a datum; bits. */
typedef enum {
  DATUM_LOAD         = 1,  /* forces */
  DATUM_DISPLACEMENT = 2,  /* given displacements */
  DATUM_GAP          = 4,  /* gaps and their offsets */
  DATUM_TEMPERATURE  = 8,  /* temperatures and what else strains a body without a force */
  DATUM_MATERIAL     = 16, /* the stiffness */
  DATUM_MESH         = 32, /* the mesh, which is made once */
  DATUM_PRETENSION   = 64, /* a mean axial force, and with it a strain without stress */
  DATUM_FRICTION     = 128 /* coefficients and bounds of friction */
} DatumKind;
/* Data that time may multiply. */
#define SCENE_STEPS_SCALABLE (DATUM_LOAD | DATUM_DISPLACEMENT | DATUM_GAP | DATUM_TEMPERATURE)

/* The same scene at several times. */
typedef struct {
  PetscInt   num;       /* 0 for one solution at time 1 */
  PetscReal *t;         /* [num] */
  PetscBool  counted;   /* whether the user gave their number, not a list */
  PetscBool  scale_set; /* whether the user said what time multiplies; */
  int        scale;     /* DatumKind bits */
  char      *restart;   /* file of the run that is gone on with, or NULL */
  PetscInt   num_past;  /* steps of that run, with those of the runs that it went on from; */
  PetscReal *past;      /* their times [num_past] */
  PetscBool  halved;    /* whether all steps are also solved in halves and quarters */
} SceneSteps;

/* A number that adaptive meshes are refined for. */
typedef enum {
  GOAL_FORCE,    /* the normal force of a pair */
  GOAL_PROBE,    /* von Mises' stress at a probe */
  GOAL_PRESSURE, /* the largest pressure of a pair */
  GOAL_COUNT
} GoalKind;

typedef struct {
  GoalKind kind;
  PetscInt owner; /* index of the pair or the probe */
  char    *text;  /* as typed, force:joint */
} SceneGoal;

/* Adaptive meshes. */
typedef struct {
  PetscBool  on;
  PetscBool  kept;      /* whether bodies of quadrilaterals keep them */
  PetscReal  tolerance; /* of the relative error in the energy norm; 0 where goals alone are asked for */
  PetscReal  marking;   /* the share of the squared estimate that marked cells have */
  PetscReal  max_unknowns;
  PetscInt   max_meshes, num_goals;
  SceneGoal *goals;          /* [num_goals] */
  PetscReal  memory;         /* bytes that all ranks together may take; infinite where nothing was said */
  PetscReal  goal_tolerance; /* of their bars, relative to their values */
} SceneAdapt;

struct _n_Scene {
  MPI_Comm    comm;
  char       *title;    /* "" where none was given */
  char       *units[4]; /* names of the units of length, force, stress and temperature, or NULL where none were given */
  PetscInt    dim;
  char       *unread; /* message for data of a solid where a mesh file alone makes the scene a plane one, or NULL */
  ModelKind   model;
  PetscReal   thickness;
  PetscInt    refine; /* common refinements: the levels */
  SceneLevels levels; /* whether a solver may need more of them */
  PetscInt    num_bodies, num_regions, num_pairs, num_probes, num_paths;
  SceneBody  *bodies;
  SceneRegion *regions; /* body after body [num_regions] */
  ScenePair   *pairs;
  SceneProbe  *probes;
  ScenePath   *paths;
  char        *output;  /* path prefix, or NULL for no files */
  int          formats; /* OutputFormat bits */
  char        *summary; /* file for the summary alone, "-" for stdout, or NULL */
  SceneStudy   study;
  SceneSteps   steps;
  PetscReal    time;       /* of SceneSetTime(); 1 in the beginning */
  int          changed;    /* DatumKind bits of the changes since the last solution, which clears them */
  PetscBool    scaled;     /* whether all that varies in time is proportional to it */
  PetscBool    tighten;    /* whether the strains of pretensions are to be found, else they are kept */
  PetscBool    keep;       /* whether solvers keep their factors for further solutions of this scene */
  PetscBool    unstrained; /* whether strains without stress count as none now: for solutions of other loads */

  SceneAdapt adapt;
  SceneStop  stop;
  PetscBool  check, cross_check, measure_linear, infsup, quiet, monitor, view, report, allow_unused, warnings_fail;
};
typedef struct _n_Scene *Scene;

/* The length of the ring of a point: 2 pi r in an axisymmetric scene, 1 in others. Not collective.
   [in] x - [dim] */
static inline PetscReal SceneRing(const struct _n_Scene *scene, const PetscReal x[])
{
  return scene->model == MODEL_AXISYMMETRIC ? 2 * PETSC_PI * x[0] : 1;
}

/* The factor of integrals over the mesh: the length of the ring, or the thickness. Not collective.
   [in] x - [dim] */
static inline PetscReal SceneMeasure(const struct _n_Scene *scene, const PetscReal x[])
{
  return scene->thickness * SceneRing(scene, x);
}

/* The degree that this factor adds to an integrand in cells or facets of an order. Not collective. */
static inline PetscInt SceneMeasureDegree(const struct _n_Scene *scene, PetscInt order)
{
  return scene->model == MODEL_AXISYMMETRIC ? order : 0;
}

/* Whether a boundary gives a load, not a support. Not collective. */
static inline PetscBool SceneBoundaryIsLoad(const SceneBoundary *boundary)
{
  return (PetscBool)(boundary->kind >= BOUNDARY_TRACTION);
}

/* A material by its index: first those of the bodies [num_bodies], then those of the regions [num_regions].
   Not collective. */
static inline const SceneMaterial *SceneGetMaterial(const struct _n_Scene *scene, PetscInt material)
{
  return material < scene->num_bodies ? &scene->bodies[material].material
                                      : &scene->regions[material - scene->num_bodies].material;
}

/* The body of a material. Not collective. */
static inline PetscInt SceneMaterialBody(const struct _n_Scene *scene, PetscInt material)
{
  return material < scene->num_bodies ? material : scene->regions[material - scene->num_bodies].body;
}

/* The first material of a body's regions; the others follow. Not collective. */
static inline PetscInt SceneBodyFirstRegion(const struct _n_Scene *scene, PetscInt body)
{
  return scene->num_bodies + scene->bodies[body].first_region;
}

/* Whether a body has strains without stress, in any of its regions. Not collective. */
static inline PetscBool SceneBodyHasEigenstrain(const struct _n_Scene *scene, PetscInt body)
{
  const SceneBody *b = &scene->bodies[body];

  if (scene->unstrained) return PETSC_FALSE;
  if (b->material.temperature || b->material.initial_strain || b->pretension) return PETSC_TRUE;
  for (PetscInt r = 0; r < b->num_regions; r++) {
    const SceneMaterial *material = SceneGetMaterial(scene, SceneBodyFirstRegion(scene, body) + r);

    if (material->temperature || material->initial_strain) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Whether a pair has friction. Not collective. */
static inline PetscBool ScenePairHasFriction(const ScenePair *pair)
{
  return (PetscBool)(pair->friction || pair->bound);
}

/* Whether any pair has friction. Not collective. */
static inline PetscBool SceneHasFriction(const struct _n_Scene *scene)
{
  for (PetscInt p = 0; p < scene->num_pairs; p++)
    if (ScenePairHasFriction(&scene->pairs[p])) return PETSC_TRUE;
  return PETSC_FALSE;
}

/* Whether all load steps are solved on each adaptive mesh: with friction, since slip counts from the step
   before on the same mesh. Not collective. */
static inline PetscBool SceneRepeatsSteps(const struct _n_Scene *scene)
{
  return (PetscBool)(scene->adapt.on && scene->steps.num && SceneHasFriction(scene));
}

/* Whether two sides, each a name or several joined with '+', have a name in common. Not collective. */
PetscBool SceneSidesShare(const char a[], const char b[]);

/* Creates an empty scene. Collective on comm. [out] scene - owned by the caller */
PetscErrorCode SceneCreate(MPI_Comm comm, Scene *scene);
/* Reads all options of the table that -help prints (src/scene/optiontable.c). User errors: all mistakes that
   can be found without a mesh. Collective on the scene's comm. */
PetscErrorCode SceneSetFromOptions(Scene scene);
/* User error: an option that nothing has read. With before_solve only options without PETSc's own prefixes
   count (ksp_, pc_, mat_, snes_, ...). PETSc reads many of its options late. -options_allow_unused makes it a
   warning. Collective. */
PetscErrorCode SceneCheckUnused(Scene scene, PetscBool before_solve);
/* Sets the t of all formulas. If no datum of the scene names t, it multiplies loads, given displacements, gap
   offsets and temperatures, or the data of -load_steps_scale. Adds what changes to scene->changed. User
   error: a map names t, but meshes do not change. Collective. */
PetscErrorCode SceneSetTime(Scene scene, PetscReal t);
/* Replaces a datum of the scene by numbers: a load, a given displacement, a temperature, a gap or its offset.
   Components that are `free` stay free. User errors: another option; another number of components.
   Collective.
   [in] option - with its dash, as in the scene; [in] values - [num] */
PetscErrorCode SceneSetDatum(Scene scene, const char option[], PetscInt num, const PetscReal values[]);
/* Prints every option, its unit and default, grouped. Not collective; needs neither PETSc nor MPI. */
void SceneHelp(FILE *file);
/* Prints the model as far as it is known without a mesh: bodies, materials, loads, pairs. Collective. */
PetscErrorCode SceneView(Scene scene);
/* Prints the beginning of the list of omitted terms, with the reasons: "left out:", and a line for each.
   Collective. */
PetscErrorCode SceneViewLeftOut(Scene scene);
PetscErrorCode SceneDestroy(Scene *scene);

#endif
