/* costforecast.c -- predicted time and memory of the next run.

   Memory = what a program takes anyway + B N^q. The first part is in the latest run of the order; B comes from the latest two,
   where they tell it: in small runs it drowns in the rest. */
#include <math.h>
#include "study/costforecast.h"
#include "study/studyimpl.h"

/* q, in the plane and in space. Factors of a plane matrix grow like N log N, which is this power over the sizes that occur;
   in space they would grow faster, but from 20000 unknowns on multigrid replaces them. */
static const PetscReal GROWTH[] = {1.15, 1};
/* B in bytes, by order 1 and 2. In the plane: measured with MUMPS on quadrilaterals, 2000 to 800000 unknowns. In space: between
   what factors take of hexahedra, up to 12000 and 15000 with 30000 unknowns, and multigrid, 2400 (order 1, 40000 to 300000). */
static const PetscReal BYTES[][2] = {{550, 700}, {6000, 12000}};
static const PetscReal MEGABYTE = 1048576, GIGABYTE = 1073741824;
/* A measured B within this factor is believed. */
static const PetscReal FACTOR = 3;

void CostForecastPrintBytes(PetscReal bytes, char text[])
{
  if (bytes < GIGABYTE)
    snprintf(text, BYTES_TEXT, "%.0f MB", (double)(bytes / MEGABYTE));
  else
    snprintf(text, BYTES_TEXT, "%.1f GB", (double)(bytes / GIGABYTE));
}

/* N^q */
static PetscReal CostForecastGrowth_Private(PetscInt dim, PetscReal unknowns)
{
  return PetscPowReal(unknowns, GROWTH[dim - 2]);
}

/* B: as measured, where that can be believed. */
static PetscReal CostForecastGetBytes_Private(const Scene scene, const CostPoint *last, const CostPoint *before)
{
  const PetscInt dim     = scene->dim;
  PetscInt       highest = 1;
  PetscReal      bytes, measured;

  for (PetscInt b = 0; b < scene->num_bodies; b++) highest = PetscMax(highest, scene->bodies[b].order);
  bytes = BYTES[dim - 2][PetscMin(highest, (PetscInt)PETSC_STATIC_ARRAY_LENGTH(BYTES[0])) - 1];
  if (!before) return bytes;
  measured = (last->bytes - before->bytes) /
             (CostForecastGrowth_Private(dim, last->unknowns) - CostForecastGrowth_Private(dim, before->unknowns));
  return PetscMin(PetscMax(measured, bytes / FACTOR), bytes * FACTOR);
}

PetscReal CostForecastNext(Scene scene, const CostPoint *last, const CostPoint *before, PetscReal unknowns)
{
  return last->bytes +
         CostForecastGetBytes_Private(scene, last, before) * (CostForecastGrowth_Private(scene->dim, unknowns) -
                                                              CostForecastGrowth_Private(scene->dim, last->unknowns));
}

PetscReal CostForecastMemory(Study study, PetscInt order, PetscInt unknowns)
{
  const Record *last   = StudyFindCoarser(study, order, study->scene->study.levels);
  const Record *before = last ? StudyFindCoarser(study, order, last->level) : NULL;
  CostPoint     points[2];

  if (!last)
    return CostForecastGetBytes_Private(study->scene, NULL, NULL) *
           CostForecastGrowth_Private(study->scene->dim, unknowns);
  points[0] = (CostPoint){.unknowns = last->unknowns, .bytes = last->own_memory};
  if (before) points[1] = (CostPoint){.unknowns = before->unknowns, .bytes = before->own_memory};
  return CostForecastNext(study->scene, &points[0], before ? &points[1] : NULL, unknowns);
}

/* Refinement makes 2^dim cells of one, and nodes of less than 2^dim times as many; marked cells alone make less than twice of all. */
PetscInt CostForecastUnknowns(Study study, const Record *record)
{
  if (study->scene->study.kind == STUDY_ADAPTIVE) return 2 * record->unknowns;
  return record->unknowns << study->scene->dim;
}
