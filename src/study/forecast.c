/* forecast.c -- what a run that was not made yet will need. */
#include <math.h>
#include "room.h"

/* Memory of a factorisation grows with unknowns to this power in 2D (nested dissection: N log N). */
static const PetscReal GROWTH = 1.15;
/* Bytes of a first run with so many unknowns, by order 1 and 2: measured with MUMPS on quadrilaterals in 2D, rounded up. */
static const PetscReal FIRST_BYTES[] = {550, 700};

PetscReal ForecastMemory(Study study, PetscInt order, PetscInt unknowns)
{
  const PetscInt highest = PETSC_STATIC_ARRAY_LENGTH(FIRST_BYTES);
  const Record  *last    = StudyFindCoarser(study, order, study->scene->study.levels);
  PetscInt       mixed   = 1;

  if (last) return last->own_memory * PetscPowReal((PetscReal)unknowns / last->unknowns, GROWTH);
  for (PetscInt b = 0; b < study->scene->num_bodies; ++b) mixed = PetscMax(mixed, study->own_orders[b]);
  if (order == STUDY_OWN_ORDERS) order = mixed;
  return FIRST_BYTES[PetscMin(order, highest) - 1] * PetscPowReal(unknowns, GROWTH);
}

/* Refinement makes 2^dim cells of one, and nodes of less than 2^dim times as many. */
PetscInt ForecastUnknowns(Study study, const Record *record)
{
  return record->unknowns << study->scene->dim;
}
