/* chain.h -- sides made of line facets, and D, M and the weighted gap between two of them. */
#ifndef CHAIN_H
#define CHAIN_H

#include <mortise/clip.h>
#include <mortise/dual.h>
#include <mortise/element.h>
#include <mortise/frame.h>
#include <test.h>
#include "uniform.h"

enum { MAX_NODES = 16, NUM_GAUSS = 3 };

/* A polygonal surface: its nodes in order, and their normals. */
typedef struct {
  PetscInt  n;
  PetscReal X[MAX_NODES][2], N[MAX_NODES][2];
} Chain;

/* What a pair of surfaces gives; gap[a] = int psi_a g n as a vector. */
typedef struct {
  PetscReal D[MAX_NODES], M[MAX_NODES][MAX_NODES], gap[MAX_NODES][2], length;
} Coupling;

/* Nodal normals from the facets; the body is on the left of the chain. */
static void ChainSetNormals(Chain *chain)
{
  for (PetscInt i = 0; i < chain->n; i++) chain->N[i][0] = chain->N[i][1] = 0.;
  for (PetscInt i = 0; i + 1 < chain->n; i++) FrameAddFacetNormal(2, 2, chain->X[i], chain->N[i]);
  for (PetscInt i = 0; i < chain->n; i++) FrameNormalize(2, chain->N[i]);
}

/* A surface over [begin,end] with random spacing and height: its outward normals look down. */
static void RandomChain(PetscInt n, PetscReal begin, PetscReal end, PetscReal height, PetscReal roughness, Chain *chain)
{
  PetscReal at[MAX_NODES] = {0.};

  for (PetscInt i = 1; i < n; i++) at[i] = at[i - 1] + Uniform(0.3, 1.);
  chain->n = n;
  for (PetscInt i = 0; i < n; i++) {
    chain->X[i][0] = begin + (end - begin) * at[i] / at[n - 1];
    chain->X[i][1] = height + Uniform(-roughness, roughness);
  }
  ChainSetNormals(chain);
}

/* All points of one nonmortar facet over the whole mortar chain; mortar[q] tells the mortar facet of each point. */
static PetscInt ChainClip(const Chain *nonmortar, PetscInt facet, const Chain *mortar, PetscInt num_gauss,
                          ClipPoint points[], PetscInt facets[])
{
  PetscInt num = 0;

  for (PetscInt f = 0; f + 1 < mortar->n; f++) {
    const PetscInt n = ClipLines(nonmortar->X[facet], nonmortar->N[facet], mortar->X[f], num_gauss, &points[num]);

    for (PetscInt q = 0; q < n; q++) facets[num++] = f;
  }
  return num;
}

/* D, M and the gap of two surfaces, as the contact room integrates them. */
static void Couple(const Chain *nonmortar, const Chain *mortar, Coupling *pair)
{
  PetscMemzero(pair, sizeof(*pair));
  for (PetscInt s = 0; s + 1 < nonmortar->n; s++) {
    ClipPoint      points[MAX_NODES * CLIP_MAX_POINTS];
    PetscInt       facets[MAX_NODES * CLIP_MAX_POINTS];
    const PetscInt num = ChainClip(nonmortar, s, mortar, NUM_GAUSS, points, facets);
    PetscReal      phi[MAX_NODES * CLIP_MAX_POINTS][2], w[MAX_NODES * CLIP_MAX_POINTS], A[4], D[2];

    for (PetscInt q = 0; q < num; q++) {
      ElementShape(ELEMENT_LINE2, points[q].xi, phi[q], NULL);
      w[q] = points[q].weight;
      pair->length += w[q];
    }
    if (!DualBasis(2, num, phi[0], w, A, D)) continue;
    for (PetscInt i = 0; i < 2; i++) pair->D[s + i] += D[i];
    for (PetscInt q = 0; q < num; q++) {
      PetscReal psi[2], phi_m[2], n[2];

      DualEvaluate(2, A, phi[q], psi);
      ElementShape(ELEMENT_LINE2, points[q].eta, phi_m, NULL);
      for (PetscInt k = 0; k < 2; k++) n[k] = phi[q][0] * nonmortar->N[s][k] + phi[q][1] * nonmortar->N[s + 1][k];
      FrameNormalize(2, n);
      for (PetscInt i = 0; i < 2; i++) {
        for (PetscInt j = 0; j < 2; j++) pair->M[s + i][facets[q] + j] += w[q] * psi[i] * phi_m[j];
        for (PetscInt k = 0; k < 2; k++) pair->gap[s + i][k] += w[q] * psi[i] * points[q].gap * n[k];
      }
    }
  }
}

#endif
