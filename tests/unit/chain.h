/* chain.h -- sides made of line facets, and D, M and the weighted gap between two of them. */
#ifndef CHAIN_H
#define CHAIN_H

#include "kernel/clip.h"
#include "kernel/dual.h"
#include "kernel/element.h"
#include "kernel/frame.h"
#include <test.h>
#include "uniform.h"

enum { MAX_NODES = 99, NUM_GAUSS = 3 };

/* A surface of segments, or of parabolas: its nodes in order, and their normals. */
typedef struct {
  PetscInt  n;
  PetscBool quadratic; /* every other node is the middle of a facet */
  PetscReal X[MAX_NODES][2], N[MAX_NODES][2];
} Chain;

/* One facet with a copy of its nodes, in the order of element.h. */
typedef struct {
  ClipFacet facet;
  PetscInt  nodes[3];
  PetscReal X[6], N[6];
} ChainFacet;

/* What a pair of surfaces gives; gap[a] = int psi_a g n as a vector. */
typedef struct {
  PetscReal D[MAX_NODES], M[MAX_NODES][MAX_NODES], gap[MAX_NODES][2], length;
} Coupling;

static PetscInt ChainNumFacets(const Chain *chain)
{
  return chain->quadratic ? (chain->n - 1) / 2 : chain->n - 1;
}

static void ChainGetFacet(const Chain *chain, PetscInt f, ChainFacet *copy)
{
  const PetscInt step = chain->quadratic ? 2 : 1, num_nodes = 1 + step;

  copy->nodes[0] = step * f;
  copy->nodes[1] = step * (f + 1);
  copy->nodes[2] = step * f + 1;
  for (PetscInt i = 0; i < 2 * num_nodes; i++) {
    copy->X[i] = chain->X[copy->nodes[i / 2]][i % 2];
    copy->N[i] = chain->N[copy->nodes[i / 2]][i % 2];
  }
  copy->facet = (ClipFacet){chain->quadratic ? ELEMENT_LINE3 : ELEMENT_LINE2, copy->X, copy->N};
}

/* Nodal normals from the facets; the body is on the left of the chain. */
static void ChainSetNormals(Chain *chain)
{
  for (PetscInt i = 0; i < chain->n; i++) chain->N[i][0] = chain->N[i][1] = 0.;
  for (PetscInt f = 0; f < ChainNumFacets(chain); f++) {
    ChainFacet side;
    PetscReal  N[6] = {0.};

    ChainGetFacet(chain, f, &side);
    FrameAddFacetNormal(2, ElementNumNodes(side.facet.type), side.X, N);
    for (PetscInt i = 0; i < 2 * ElementNumNodes(side.facet.type); i++) chain->N[side.nodes[i / 2]][i % 2] += N[i];
  }
  for (PetscInt i = 0; i < chain->n; i++) FrameNormalize(2, chain->N[i]);
}

/* A surface over [begin,end] with random spacing and height: its outward normals look down. Of a quadratic one, whose
   number of nodes is odd, all nodes are shaken. */
static void RandomChain(PetscBool quadratic, PetscInt n, PetscReal begin, PetscReal end, PetscReal height,
                        PetscReal roughness, Chain *chain)
{
  PetscReal at[MAX_NODES] = {0.};

  for (PetscInt i = 1; i < n; i++) at[i] = at[i - 1] + Uniform(0.3, 1.);
  for (PetscInt i = 1; i < n && quadratic; i += 2)
    at[i] = 0.5 * (at[i - 1] + at[i + 1]) + Uniform(-roughness, roughness);
  chain->n         = n;
  chain->quadratic = quadratic;
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
  ChainFacet side, other;
  PetscInt   num = 0;

  ChainGetFacet(nonmortar, facet, &side);
  for (PetscInt f = 0; f < ChainNumFacets(mortar); f++) {
    PetscInt n;

    ChainGetFacet(mortar, f, &other);
    n = ClipLines(&side.facet, &other.facet, num_gauss, &points[num]);
    for (PetscInt q = 0; q < n; q++) facets[num++] = f;
  }
  return num;
}

/* D, M and the gap of two surfaces, as the contact room integrates them. */
static void Couple(const Chain *nonmortar, const Chain *mortar, PetscInt num_gauss, Coupling *pair)
{
  PetscMemzero(pair, sizeof(*pair));
  for (PetscInt s = 0; s < ChainNumFacets(nonmortar); s++) {
    ClipPoint      points[MAX_NODES * CLIP_MAX_POINTS];
    PetscInt       facets[MAX_NODES * CLIP_MAX_POINTS];
    const PetscInt num = ChainClip(nonmortar, s, mortar, num_gauss, points, facets);
    PetscReal      xi[MAX_NODES * CLIP_MAX_POINTS][2], w[MAX_NODES * CLIP_MAX_POINTS];
    ChainFacet     side, other;
    DualBasis      dual;

    ChainGetFacet(nonmortar, s, &side);
    for (PetscInt q = 0; q < num; q++) {
      for (PetscInt k = 0; k < 2; k++) xi[q][k] = points[q].xi[k];
      w[q] = points[q].weight;
      pair->length += w[q];
    }
    if (!DualBasisCreate(side.facet.type, num, xi[0], w, NULL, &dual)) continue;
    for (PetscInt i = 0; i < ElementNumNodes(side.facet.type); i++) pair->D[side.nodes[i]] += dual.D[i];
    for (PetscInt q = 0; q < num; q++) {
      PetscReal psi[3], phi[3], n[2] = {0., 0.};

      DualBasisEvaluate(&dual, points[q].xi, psi);
      ElementShape(side.facet.type, points[q].xi, phi, NULL);
      for (PetscInt i = 0; i < 2 * ElementNumNodes(side.facet.type); i++) n[i % 2] += phi[i / 2] * side.N[i];
      FrameNormalize(2, n);
      ChainGetFacet(mortar, facets[q], &other);
      ElementShape(other.facet.type, points[q].eta, phi, NULL);
      for (PetscInt i = 0; i < ElementNumNodes(side.facet.type); i++) {
        const PetscInt a = side.nodes[i];

        for (PetscInt j = 0; j < ElementNumNodes(other.facet.type); j++)
          pair->M[a][other.nodes[j]] += w[q] * psi[i] * phi[j];
        for (PetscInt k = 0; k < 2; k++) pair->gap[a][k] += w[q] * psi[i] * points[q].gap * n[k];
      }
    }
  }
}

/* D and M do not notice that everything is turned and moved together. [in] n - nodes of the mortar side, odd where quadratic */
static void CheckRigidMotion(PetscBool quadratic, PetscInt n, PetscInt num_gauss, PetscReal tolerance)
{
  for (PetscInt trial = 0; trial < 100; trial++) {
    const PetscReal angle = Uniform(0., 6.), c = PetscCosReal(angle), s = PetscSinReal(angle), shift = Uniform(-1., 1.);
    Chain           chains[2];
    Coupling        before, after;

    RandomChain(quadratic, 5, 0., 1., 0., 0.05, &chains[0]);
    RandomChain(quadratic, n, -0.1, 1.1, -0.2, 0.05, &chains[1]);
    Couple(&chains[0], &chains[1], num_gauss, &before);
    for (PetscInt k = 0; k < 2; k++) {
      for (PetscInt i = 0; i < chains[k].n; i++) {
        const PetscReal x = chains[k].X[i][0], y = chains[k].X[i][1];

        chains[k].X[i][0] = c * x - s * y + shift;
        chains[k].X[i][1] = s * x + c * y - shift;
      }
      ChainSetNormals(&chains[k]);
    }
    Couple(&chains[0], &chains[1], num_gauss, &after);
    for (PetscInt a = 0; a < 5; a++) {
      CHECK_NEAR(after.D[a], before.D[a], tolerance);
      for (PetscInt b = 0; b < n; b++) CHECK_NEAR(after.M[a][b], before.M[a][b], tolerance);
    }
  }
}

#endif
