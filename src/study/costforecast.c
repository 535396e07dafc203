/* costforecast.c -- predicted time and memory of the next run.

   Memory = what a program takes anyway + B N^q. The first part is in the latest run of the order; B comes from the latest two,
   where they tell it: in small runs it drowns in the rest. */
#include <math.h>
#include "study/studyimpl.h"

/* q, in the plane and in space. Factors of a plane matrix grow like N log N, which is this power over the sizes that occur;
   in space they would grow faster, but from 20000 unknowns on multigrid replaces them. */
static const PetscReal GROWTH[] = {1.15, 1};
/* B in bytes, by order 1 and 2. In the plane: measured with MUMPS on quadrilaterals, 2000 to 800000 unknowns. In space: between
   what factors take of hexahedra, up to 12000 and 15000 with 30000 unknowns, and multigrid, 2400 (order 1, 40000 to 300000). */
static const PetscReal BYTES[][2] = {{550, 700}, {6000, 12000}};
/* A measured B within this factor is believed. */
static const PetscReal FACTOR = 3;

/* N^q */
static PetscReal CostForecastGrowth_Private(PetscInt dim, PetscInt unknowns)
{
  return PetscPowReal((PetscReal)unknowns, GROWTH[dim - 2]);
}

PetscReal CostForecastMemory(Study study, PetscInt order, PetscInt unknowns)
{
  const Record *last    = StudyFindCoarser(study, order, study->scene->study.levels);
  const Record *before  = last ? StudyFindCoarser(study, order, last->level) : NULL;
  PetscInt      highest = 1, dim = study->scene->dim;
  PetscReal     bytes;

  for (PetscInt b = 0; b < study->scene->num_bodies; b++) highest = PetscMax(highest, study->scene->bodies[b].order);
  bytes = BYTES[dim - 2][PetscMin(highest, (PetscInt)PETSC_STATIC_ARRAY_LENGTH(BYTES[0])) - 1];
  if (!last) return bytes * CostForecastGrowth_Private(dim, unknowns);
  if (before) {
    const PetscReal measured =
        (last->own_memory - before->own_memory) /
        (CostForecastGrowth_Private(dim, last->unknowns) - CostForecastGrowth_Private(dim, before->unknowns));

    bytes = PetscMin(PetscMax(measured, bytes / FACTOR), bytes * FACTOR);
  }
  return last->own_memory +
         bytes * (CostForecastGrowth_Private(dim, unknowns) - CostForecastGrowth_Private(dim, last->unknowns));
}

/* Refinement makes 2^dim cells of one, and nodes of less than 2^dim times as many; marked cells alone make less than twice of all. */
PetscInt CostForecastUnknowns(Study study, const Record *record)
{
  if (study->scene->study.kind == STUDY_ADAPTIVE) return 2 * record->unknowns;
  return record->unknowns << study->scene->dim;
}
