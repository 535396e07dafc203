/* forecast.c -- what a run that was not made yet will need.

   Memory = what a program takes anyway + B N^q. The first part is in the latest run of the order; B comes from the latest two,
   where they tell it: in small runs it drowns in the rest. */
#include <math.h>
#include "room.h"

/* q: factors of a matrix in 2D grow like N log N, which is this power over the sizes that occur. */
static const PetscReal GROWTH = 1.15;
/* B in bytes, by order 1 and 2: measured with MUMPS on quadrilaterals in 2D, 2000 to 800000 unknowns. */
static const PetscReal BYTES[] = {550, 700};
/* A measured B within this factor is believed. */
static const PetscReal FACTOR = 3;

/* N^q */
static PetscReal Growth_Private(PetscInt unknowns)
{
  return PetscPowReal((PetscReal)unknowns, GROWTH);
}

PetscReal ForecastMemory(Study study, PetscInt order, PetscInt unknowns)
{
  const Record *last    = StudyFindCoarser(study, order, study->scene->study.levels);
  const Record *before  = last ? StudyFindCoarser(study, order, last->level) : NULL;
  PetscInt      highest = 1;
  PetscReal     bytes;

  for (PetscInt b = 0; b < study->scene->num_bodies; ++b) highest = PetscMax(highest, study->scene->bodies[b].order);
  bytes = BYTES[PetscMin(highest, (PetscInt)PETSC_STATIC_ARRAY_LENGTH(BYTES)) - 1];
  if (!last) return bytes * Growth_Private(unknowns);
  if (before) {
    const PetscReal measured =
        (last->own_memory - before->own_memory) / (Growth_Private(last->unknowns) - Growth_Private(before->unknowns));

    bytes = PetscMin(PetscMax(measured, bytes / FACTOR), bytes * FACTOR);
  }
  return last->own_memory + bytes * (Growth_Private(unknowns) - Growth_Private(last->unknowns));
}

/* Refinement makes 2^dim cells of one, and nodes of less than 2^dim times as many. */
PetscInt ForecastUnknowns(Study study, const Record *record)
{
  return record->unknowns << study->scene->dim;
}
