/* surfaces.h -- small surfaces in space and the integrals of a pair of them, for the tests of overlaps. */
#ifndef MORTISE_SURFACES_H
#define MORTISE_SURFACES_H

#include "kernel/clip.h"
#include "kernel/dual.h"
#include "kernel/frame.h"

#include "uniform.h"

static const PetscReal EXACT = 1e-13;

enum { MAX_NODES = 256, MAX_FACETS = 128, NUM_TYPES = 4, DIM = 3 };

static const ElementType TYPES[NUM_TYPES] = {ELEMENT_TRI3, ELEMENT_QUAD4, ELEMENT_TRI6, ELEMENT_QUAD9};

/* A surface of facets of one type. */
typedef struct {
  ElementType type;
  PetscInt    num_nodes, num_facets, nodes[MAX_FACETS][ELEMENT_MAX_FACET_NODES];
  PetscReal   X[MAX_NODES][DIM], N[MAX_NODES][DIM];
} Surface;

typedef struct {
  PetscReal D[MAX_NODES], M[MAX_NODES][MAX_NODES], gap[MAX_NODES], area;
} Coupling;

static ClipPoint points[CLIP_MAX_POLYGON_POINTS];

/* Rows orthonormal and right-handed: the last one is the normal of what lies in the plane of the first two. */
static inline void RandomFrame(PetscReal Q[3][3])
{
  PetscReal normal[3], frame[9];

  for (PetscInt k = 0; k < 3; k++) normal[k] = Uniform(-1., 1.);
  FrameNormalize(3, normal);
  FrameFromNormal(3, normal, frame);
  for (PetscInt k = 0; k < 3; k++) {
    Q[0][k] = frame[3 + k];
    Q[1][k] = frame[6 + k];
    Q[2][k] = frame[k];
  }
}

/* Turns x into sum_i x_i Q_i. */
static inline void Turn(PetscReal Q[3][3], PetscReal x[])
{
  const PetscReal before[3] = {x[0], x[1], x[2]};

  for (PetscInt k = 0; k < 3; k++) x[k] = before[0] * Q[0][k] + before[1] * Q[1][k] + before[2] * Q[2][k];
}

static inline void SurfaceTurn(PetscReal Q[3][3], Surface *s)
{
  for (PetscInt i = 0; i < s->num_nodes; i++) {
    Turn(Q, s->X[i]);
    Turn(Q, s->N[i]);
  }
}

/* Nodes of one facet. [out] X, N - [num_nodes][3] */
static inline void FacetSet(const Surface *s, PetscInt f, PetscReal X[], PetscReal N[], ClipFacet *facet)
{
  for (PetscInt i = 0; i < ElementNumNodes(s->type); i++) {
    for (PetscInt k = 0; k < DIM; k++) {
      X[DIM * i + k] = s->X[s->nodes[f][i]][k];
      N[DIM * i + k] = s->N[s->nodes[f][i]][k];
    }
  }
  *facet = (ClipFacet){s->type, X, N};
}

/* D, M and the weighted gap of a nonmortar surface, facet by facet. The nodes of tri6 are those of u~, which have the same
   places where edges are straight. */
static inline void Couple(const Surface *nonmortar, const Surface *mortar, Coupling *pair)
{
  static PetscReal xi[2 * CLIP_MAX_POLYGON_POINTS], w[CLIP_MAX_POLYGON_POINTS], psi[DUAL_MAX], phi[DUAL_MAX];
  static ClipPoint all[CLIP_MAX_POLYGON_POINTS];
  static PetscInt  facet_of[CLIP_MAX_POLYGON_POINTS];
  const PetscInt   degree = ClipDegree(nonmortar->type, mortar->type);

  PetscCallAbort(PETSC_COMM_SELF, PetscMemzero(pair, sizeof(*pair)));
  for (PetscInt f = 0; f < nonmortar->num_facets; f++) {
    PetscReal X[DIM * ELEMENT_MAX_FACET_NODES], N[DIM * ELEMENT_MAX_FACET_NODES];
    ClipFacet own;
    PetscInt  num = 0;
    DualBasis dual;

    FacetSet(nonmortar, f, X, N, &own);
    for (PetscInt g = 0; g < mortar->num_facets; g++) {
      PetscReal      Y[DIM * ELEMENT_MAX_FACET_NODES], unused[DIM * ELEMENT_MAX_FACET_NODES];
      ClipFacet      other;
      const PetscInt before = num;

      FacetSet(mortar, g, Y, unused, &other);
      for (PetscInt q = ClipPolygons(&own, &other, degree, points); q > 0; q--) all[num++] = points[q - 1];
      for (PetscInt q = before; q < num; q++) facet_of[q] = g;
    }
    for (PetscInt q = 0; q < num; q++) {
      xi[2 * q]     = all[q].xi[0];
      xi[2 * q + 1] = all[q].xi[1];
      w[q]          = all[q].weight;
      pair->area += w[q];
    }
    if (!DualBasisCreate(nonmortar->type, num, xi, w, NULL, &dual)) continue;
    for (PetscInt i = 0; i < ElementNumNodes(nonmortar->type); i++) pair->D[nonmortar->nodes[f][i]] += dual.D[i];
    for (PetscInt q = 0; q < num; q++) {
      DualBasisEvaluate(&dual, all[q].xi, psi);
      ElementShape(mortar->type, all[q].eta, phi, NULL);
      for (PetscInt i = 0; i < ElementNumNodes(nonmortar->type); i++) {
        const PetscInt a = nonmortar->nodes[f][i];

        pair->gap[a] += w[q] * psi[i] * all[q].gap;
        for (PetscInt j = 0; j < ElementNumNodes(mortar->type); j++)
          pair->M[a][mortar->nodes[facet_of[q]][j]] += w[q] * psi[i] * phi[j];
      }
    }
  }
}

/* One facet or two in the plane z = 0, seen from above. [in] nodes - [num_facets][facet nodes] */
static inline void Flat(ElementType type, PetscInt num_nodes, const PetscReal P[], PetscInt num_facets,
                        const PetscInt nodes[], Surface *s)
{
  const PetscInt n = ElementNumNodes(type);

  *s = (Surface){.type = type, .num_nodes = num_nodes, .num_facets = num_facets};
  for (PetscInt i = 0; i < num_nodes; i++) {
    s->X[i][0] = P[2 * i];
    s->X[i][1] = P[2 * i + 1];
    s->N[i][2] = 1.;
  }
  for (PetscInt i = 0; i < num_facets * n; i++) s->nodes[i / n][i % n] = nodes[i];
}

#endif
