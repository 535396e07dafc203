/* extrapolation.c -- quantities of a study extrapolated to h = 0. */
#include <math.h>
#include "base/compat.h"
#include "base/warning.h"
#include "study/extrapolation.h"

static const PetscReal QUANTITY_ROUNDING = 1e-9; /* relative rounding of a quantity */

/* The solved record of an order on a level, or NULL. */
static const Record *ExtrapolationFindRecords_Private(Study study, PetscInt order, PetscInt level)
{
  for (PetscInt r = 0; r < study->num; r++) {
    const Record *record = &study->records[r];

    if (record->order == order && record->level == level && record->state == RECORD_SOLVED) return record;
  }
  return NULL;
}

PetscBool ExtrapolationOfQuantity(Study study, PetscInt quantity, PetscInt order, Extrapolation *limit)
{
  const Record *finest = StudyFindCoarser(study, order, study->scene->study.levels);
  PetscReal     values[RICHARDSON_LEVELS];

  if (study->scene->study.kind == STUDY_ADAPTIVE) return PETSC_FALSE; // h is not halved
  for (PetscInt i = 0; i < RICHARDSON_LEVELS; i++) {
    const Record *record =
        finest ? ExtrapolationFindRecords_Private(study, order, finest->level - (RICHARDSON_LEVELS - 1) + i) : NULL;

    if (!record || !isfinite((double)record->values[quantity])) return PETSC_FALSE;
    values[i] = record->values[quantity];
  }
  *limit = RichardsonExtrapolate(values);
  return PETSC_TRUE;
}

PetscInt ExtrapolationFindBest(Study study, PetscInt quantity)
{
  PetscReal smallest = PETSC_INFINITY;
  PetscInt  best     = -1;

  for (PetscInt o = 0; o < study->num_orders; o++) {
    const PetscInt order = study->scene->study.orders[o];
    Extrapolation  limit;

    if (!ExtrapolationOfQuantity(study, quantity, order, &limit) || limit.bar >= smallest) continue;
    smallest = limit.bar;
    best     = order;
  }
  return best;
}

PetscBool ExtrapolationVanishes(Study study, PetscInt quantity, const Extrapolation *limit)
{
  const Record *finest = StudyFindCoarser(study, ExtrapolationFindBest(study, quantity), study->scene->study.levels);
  PetscReal     size   = 0;

  for (PetscInt q = 0; q < study->num_quantities; q++)
    if (study->quantities[q].size == study->quantities[quantity].size)
      size = PetscMax(size, PetscAbsReal(finest->values[q]));
  return (PetscBool)(PetscAbsReal(limit->value) + limit->bar <= QUANTITY_ROUNDING * size);
}

/* The best extrapolation of a quantity. Returns whether there is one that does not vanish.
   [out] order - of it */
static PetscBool ExtrapolationGetTold_Private(Study study, PetscInt q, PetscInt *order, Extrapolation *limit)
{
  *order = ExtrapolationFindBest(study, q);
  if (*order < 0 || !ExtrapolationOfQuantity(study, q, *order, limit)) return PETSC_FALSE;
  return (PetscBool)!ExtrapolationVanishes(study, q, limit);
}

PetscErrorCode ExtrapolationWarn(Study study)
{
  const char   *first = NULL;
  PetscInt      num   = 0, order;
  Extrapolation limit;
  char          more[48] = "";

  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < study->num_quantities; q++) {
    if (!ExtrapolationGetTold_Private(study, q, &order, &limit) || limit.monotone) continue;
    if (!num++) first = study->quantities[q].label;
  }
  if (!num) PetscFunctionReturn(PETSC_SUCCESS);
  if (num > 1) PetscCall(PetscSNPrintf(more, sizeof(more), ", and %" PetscInt_FMT " more", num - 1));
  PetscCall(WarningAdd(&(Warning){.code = "not_monotone", .advice = "ask for more levels, or begin with a finer mesh"},
                       "extrapolated values of the study whose last three levels are not monotone: %s%s; their "
                       "uncertainty is the spread of the three",
                       first, more));
  PetscFunctionReturn(PETSC_SUCCESS);
}

PetscErrorCode ExtrapolationPrint(Study study)
{
  const MPI_Comm comm  = study->scene->comm;
  PetscBool      begun = PETSC_FALSE;

  PetscFunctionBeginUser;
  for (PetscInt q = 0; q < study->num_quantities; q++) {
    Record        sample = {0};
    Extrapolation limit;
    char          text[RICHARDSON_TEXT], order[ERROR_TEXT];

    if (!ExtrapolationGetTold_Private(study, q, &sample.order, &limit)) continue;
    if (!begun) PetscCall(PetscPrintf(comm, "extrapolated from the last three levels (Richardson)\n"));
    begun = PETSC_TRUE;
    RichardsonText(&limit, text, sizeof(text));
    RecordOrderText(&sample, order);
    PetscCall(PetscPrintf(comm, "  %-32s %-28s (%s%s)\n", study->quantities[q].label, text, order,
                          limit.monotone ? "" : "; not monotone: spread of the three values"));
  }
  if (!begun && study->scene->study.kind == STUDY_UNIFORM)
    PetscCall(PetscPrintf(comm, "no extrapolated values: Richardson's method needs three levels of one order\n"));
  PetscFunctionReturn(PETSC_SUCCESS);
}
