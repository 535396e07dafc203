/* costforecast.c -- predicted memory of the next run.

   Memory = A + B N^q, with N unknowns. A is that of any run. B comes from the latest two runs of the order,
   unless these are too small to show it. */
#include "study/costforecast.h"
#include "study/studyimpl.h"

/* q, in the plane and in space. Factors of a plane matrix grow like N log N, which is this power for the
   sizes of studies. In space they would grow faster, but multigrid replaces large factorizations. */
static const PetscReal GROWTH[] = {1.15, 1};
/* B in bytes, by order 1 and 2. In the plane: measured with MUMPS on quadrilaterals, 2000 to 800000 unknowns.
   In space, a value between those of factors of hexahedra and of multigrid. The first are up to 12000 and
   15000 with 30000 unknowns, the second 2400 (order 1, 40000 to 300000 unknowns). */
static const PetscReal BYTES[][2] = {{550, 700}, {6000, 12000}};
static const PetscReal MEGABYTE = 1048576, GIGABYTE = 1073741824;
/* A measured B is used up to this factor from the one above. */
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

/* B: as measured, within FACTOR of the standard one. */
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
  const PetscReal growth = CostForecastGrowth_Private(scene->dim, last->unknowns);
  PetscReal       bytes  = CostForecastGetBytes_Private(scene, last, before);

  if (!before) bytes = PetscMin(bytes, last->bytes / growth); // A is not negative
  return last->bytes + bytes * (CostForecastGrowth_Private(scene->dim, unknowns) - growth);
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

/* Uniform refinement multiplies nodes by less than 2^dim, refinement of marked cells by less than two. */
PetscInt CostForecastUnknowns(Study study, const Record *record)
{
  if (study->scene->study.kind == STUDY_ADAPTIVE) return 2 * record->unknowns;
  return record->unknowns << study->scene->dim;
}
