/* loadterm.h -- one load datum on the cells or facets of this rank. */
#ifndef MORTISE_LOADTERM_H
#define MORTISE_LOADTERM_H

#include "kernel/cubature.h"
#include "level/level.h"

typedef struct {
  Scene            scene;
  Level           *level;
  Expression       value;
  Expression       switches; /* zero where value jumps or bends; NULL where that is not known, or nothing asks for it */
  PetscBool        pressure; /* else value is a force per volume or area, */
  PetscBool        total;    /* or a total of the side, spread as traction + spin x (x - centre) */
  PetscReal        traction[3], spin[3], centre[3]; /* of a total */
  PetscBool        on_facets;                       /* of a side; else on the cells of the body */
  PetscBool        formula;                         /* else plain numbers */
  PetscInt         body, dim;
  Facets           facets;  /* of a traction or pressure */
  PetscInt         num;     /* elements: facets, or cells of the body */
  ElementType     *type;    /* [num] */
  const PetscInt **nodes;   /* local nodes of each [num] */
  PetscReal       *own;     /* sum_i |int phi_i t| by the larger of two rules; formulas only [num][dim] */
  PetscReal       *miss;    /* largest difference of two rules; formulas only [num][dim] */
  PetscInt        *points;  /* along each coordinate of the rule that replaces LoadElementIntegrate(), or 0 [num] */
  PetscReal        sums[3]; /* of own, on this rank */
} LoadTerm;

/* An element of a term with what its integrand needs. */
typedef struct {
  const LoadTerm *term;
  ElementType     type;
  PetscInt        num_nodes;
  const PetscInt *nodes;
  PetscReal       X[3 * ELEMENT_MAX_NODES]; /* [num_nodes][dim] */
} LoadElement;

/* A load on the facets of a side of a body, or where boundary is NULL on the cells of a material. Collective.
   [in] material - or the body; [out] term - to be freed by LoadTermDestroy() */
PetscErrorCode LoadTermCreate(Scene scene, Level *level, PetscInt material, const SceneBoundary *boundary,
                              LoadTerm *term);
PetscErrorCode LoadTermDestroy(LoadTerm *term);
/* Spreads the total force or moment of a side: sets traction, spin, centre. Collective.
   [in] moment - whether value is a moment */
PetscErrorCode LoadTermSpread(LoadTerm *term, PetscBool moment);
/* The centroid of a side. Collective. [out] centre - [3]; [out] area - with the measure */
PetscErrorCode LoadTermCentroid(const LoadTerm *term, PetscReal centre[], PetscReal *area);

/* Degree of the rule for facets of an order. */
PetscInt LoadElementFacetDegree(PetscInt order);
void     LoadElementSet(const LoadTerm *term, PetscInt e, LoadElement *element);
/* value_i = weight phi_i t dx/dxi at xi, t the force per area or volume. Not collective.
   [out] value - [num_nodes][dim] */
PetscErrorCode LoadElementValue(const LoadElement *element, const PetscReal xi[], PetscReal weight, PetscReal value[]);
/* fe = the integrals over the element by the rule that loads have where they are smooth. Not collective. */
PetscErrorCode LoadElementIntegrate(const LoadElement *element, PetscReal fe[]);
/* fa += scale fe. [in] fe - [num_nodes][dim]; [in,out] fa - [level->num_nodes][dim] */
void LoadElementAdd(const LoadElement *element, PetscReal scale, const PetscReal fe[], PetscScalar fa[]);

/* sums_k += sum_i |fe_ik|. [in] fe - [num_nodes][dim]; [in,out] sums - [dim] */
void LoadElementSums(const LoadElement *element, const PetscReal fe[], PetscReal sums[]);

/* Compares the integrals of LoadElementIntegrate() over element e with those of a second rule: writes own and
   miss of the term. Where another rule is needed and sure to be enough, writes its points and fe. Not
   collective.
   [in,out] fe - [num_nodes][dim] */
PetscErrorCode LoadElementCheck(const LoadElement *element, PetscInt e, PetscReal fe[]);
/* Integrates formulas anew where two rules differ, and warns of what is not reached. Collective; own and miss
   of all elements are set.
   [in,out] fa - holds the integrals of all elements after LoadElementCheck() [level->num_nodes][dim] */
PetscErrorCode LoadTermsRefine(Level *level, PetscInt num, LoadTerm terms[], PetscScalar fa[]);

#endif
