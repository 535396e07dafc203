/* sceneunits.c -- names of the units of length, force, stress and temperature, which label results. Numbers
   are never converted. */
#include "scene/sceneparts.h"
#include <string.h>

enum {
  UNITS_NEEDED  = 3,
  UNITS_MOST    = 4,
  UNITS_LONGEST = 15
}; /* names: without and with that of temperature; bytes of one */

static const PetscReal UNITS_AGREE =
    1e-3; /* relative: names of units that fit differ by rounding, others by a factor */

typedef struct {
  const char *name;
  PetscReal   size; /* in metres, newtons or pascals */
} KnownUnit;

static const KnownUnit lengths[]  = {{"m", 1},     {"cm", 1e-2},   {"mm", 1e-3},   {"um", 1e-6}, {"\xc2\xb5m", 1e-6},
                                     {"nm", 1e-9}, {"in", 0.0254}, {"ft", 0.3048}, {"km", 1e3},  {NULL, 0}};
static const KnownUnit forces[]   = {{"N", 1},
                                     {"uN", 1e-6},
                                     {"mN", 1e-3},
                                     {"kN", 1e3},
                                     {"MN", 1e6},
                                     {"kgf", 9.80665},
                                     {"lbf", 4.4482216152605},
                                     {"kip", 4448.2216152605},
                                     {NULL, 0}};
static const KnownUnit stresses[] = {{"Pa", 1},
                                     {"kPa", 1e3},
                                     {"MPa", 1e6},
                                     {"GPa", 1e9},
                                     {"bar", 1e5},
                                     {"N/mm^2", 1e6},
                                     {"psi", 6894.757293168},
                                     {"ksi", 6894757.293168},
                                     {NULL, 0}};

/* Size of a unit, or 0 if it is not known. */
static PetscReal UnitsFind_Private(const KnownUnit known[], const char name[])
{
  for (PetscInt i = 0; known[i].name; i++) {
    if (strcmp(known[i].name, name) == 0) return known[i].size;
  }
  return 0;
}

/* Stress is force over length squared in every result. Where all three names are known, they have to agree
   with that. */
static PetscErrorCode UnitsCheck_Private(Scene scene, const Option *option)
{
  char *const    *names  = scene->units;
  const PetscReal length = UnitsFind_Private(lengths, names[0]), force = UnitsFind_Private(forces, names[1]),
                  stress = UnitsFind_Private(stresses, names[2]);
  PetscReal ratio;

  PetscFunctionBeginUser;
  if (length == 0 || force == 0 || stress == 0) PetscFunctionReturn(PETSC_SUCCESS);
  ratio = force / (length * length) / stress;
  if (PetscAbsReal(ratio - 1) <= UNITS_AGREE) PetscFunctionReturn(PETSC_SUCCESS);
  PetscCall(OptionRaise(option,
                        "1 %s over 1 %s^2 is %.6g %s, and the stress of results is force over length squared; give "
                        "three units that fit, such as mm,N,MPa or m,N,Pa",
                        names[1], names[0], (double)ratio, names[2]));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode SceneUnitsRead(Scene scene)
{
  Option      units;
  const char *cursor = NULL;
  char        name[OPTION_MAX];
  PetscInt    num;

  PetscFunctionBeginUser;
  PetscCall(OptionFind(scene, "-units", NULL, NULL, &units));
  if (!units.set) PetscFunctionReturn(PETSC_SUCCESS);
  num = OptionCountItems(&units);
  if (num < UNITS_NEEDED || num > UNITS_MOST) {
    PetscCall(OptionRaise(&units,
                          "%" PetscInt_FMT " %s given, 3 wanted: the units of length, force and stress, such as "
                          "mm,N,MPa; and that of temperature where there is one, such as mm,N,MPa,K",
                          num, num == 1 ? "name" : "names"));
  }
  for (PetscInt i = 0; i < num; i++) {
    PetscCall(OptionNextItem(&units, &cursor, name));
    if (strlen(name) > UNITS_LONGEST) {
      PetscCall(OptionRaise(&units, "'%.40s' is no name of a unit; names of units have at most %d bytes", name,
                            UNITS_LONGEST));
    }
    PetscCall(PetscStrallocpy(name, &scene->units[i]));
  }
  PetscCall(UnitsCheck_Private(scene, &units));
  PetscFunctionReturn(PETSC_SUCCESS);
}
