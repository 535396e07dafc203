/* unmodelled.c -- options that other programs have and this one cannot have: what is not modelled, and what
   to give instead. */
#include "scene/sceneparts.h"
#include <string.h>
#include <strings.h>

enum { MAX_WORDS = 13 };

typedef struct {
  const char
      *words[MAX_WORDS]; /* of an option's name behind the name of its body or pair; more words may follow or precede */
  const char *sentence;
} Unmodelled;

static const Unmodelled unmodelled[] = {
    {{"n", "np", "num_procs", "processes", "ranks", "threads", "cores"},
     "there is no such option; the number of processes is one of mpiexec: mpiexec -n 4 mortise -options_file ..."},
    {{"mu", "frictional", "tresca", "coulomb", "stick", "friction_coefficient", "friction_angle"},
     "there is no such option; friction of a pair is its coefficient, -<pair>_friction, or -<pair>_friction_bound"},
    {{"gravity", "weight", "acceleration", "g"},
     "there is no such option; the weight of a body is its force per volume, -<body>_body_force, density times "
     "gravity"},
    {{"density", "rho", "mass", "inertia"},
     "mass is not modelled, bodies are in static equilibrium; a weight is -<body>_body_force, density times gravity"},
    {{"damping", "viscosity", "viscous", "creep", "relaxation", "velocity", "frequency", "time_step"},
     "effects of time are not modelled, bodies are in static equilibrium; omit the option"},
    {{"plasticity", "plastic", "yield", "sigma_y", "hardening", "damage"},
     "plasticity is not modelled, bodies are linearly elastic; compare the von Mises stress of the result with the "
     "yield "
     "stress"},
    {{"large_strain", "large_strains", "nlgeom", "finite_strain", "large_displacement", "large_deformation",
      "large_rotation", "hyperelastic", "neo_hookean", "mooney_rivlin"},
     "large strains and rotations are not modelled; the warning model_limit is given where a result exceeds small "
     "ones"},
    {{"contact_stiffness", "penalty", "penalty_stiffness", "penetration", "normal_stiffness", "augmentation"},
     "contact has no penalty and no stiffness of its own, sides do not penetrate; omit the option"},
    {{"adhesion", "cohesion", "cohesive", "wear", "lubrication", "clearance_damping"},
     "contact only pushes, without adhesion, wear or lubrication; omit the option, or tie the sides "
     "(-<pair>_type tied)"},
    {{"spring", "springs", "spring_stiffness", "foundation", "winkler"},
     "springs are not modelled; tie a soft body to the side (-<pair>_type tied)"},
    {{"point_load", "point_force", "nodal_force", "nodal_load", "concentrated_force"},
     "forces on a point are not modelled, their displacement is infinite; load a side, -<body>_bc_traction"},
    {{"e", "nu", "modulus", "elastic_modulus", "youngs_modulus", "young_modulus", "poisson_ratio", "poissons_ratio",
      "shear_modulus", "bulk_modulus", "lambda", "lame", "material"},
     "there is no such option; the material of a body is -<body>_young and -<body>_poisson, or -<body>_stiffness"},
    {{"bc_normal_"},
     "there is no such option; -<body>_bc_normal lists sides that do not move along their normals, and takes no "
     "values; "
     "others are -<body>_bc_displacement_<side>, with `free` for components that are not given"},
    {{"bc_fixed", "fixed", "fix", "clamped", "bc_clamped", "encastre", "support", "bc_symmetry", "symmetry"},
     "there is no such option; supports are -<body>_bc_displacement, and -<body>_bc_normal for planes of symmetry"},
};

/* Whether the words of a name, joined by underscores, begin or end with these words, or are these. A single
   letter is too short for parts of names. Words that end with an underscore only begin names. */
static PetscBool UnmodelledHas_Private(const char name[], const char words[])
{
  const size_t num = strlen(name), length = strlen(words);

  if (words[length - 1] == '_') return (PetscBool)!strncasecmp(name, words, length);
  if (num == length) return (PetscBool)!strcasecmp(name, words);
  if (num < length || length == 1) return PETSC_FALSE;
  if (!strncasecmp(name, words, length) && name[length] == '_') return PETSC_TRUE;
  return (PetscBool)(name[num - length - 1] == '_' && !strcasecmp(&name[num - length], words));
}

const char *UnmodelledFind(const char name[])
{
  for (size_t i = 0; i < PETSC_STATIC_ARRAY_LENGTH(unmodelled); i++) {
    for (PetscInt w = 0; w < MAX_WORDS && unmodelled[i].words[w]; w++) {
      if (UnmodelledHas_Private(name, unmodelled[i].words[w])) return unmodelled[i].sentence;
    }
  }
  return NULL;
}
