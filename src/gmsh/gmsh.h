/* gmsh.h -- a Gmsh file as plain lists.

   PETSc has a reader, DMPlexCreateGmsh(). It does not check references between sections, and it reads neither
   serendipity cells nor cells of second order of two kinds in one file. */
#ifndef MORTISE_GMSH_H
#define MORTISE_GMSH_H

#include "gmsh/gmshtype.h"

/* Physical groups that have a name. */
typedef struct {
  PetscInt  num;
  PetscInt *dim, *tag; /* [num] */
  char    **name;      /* [num] */
} GmshNames;

PetscErrorCode GmshNamesDestroy(GmshNames *names);
/* The number of a physical group by its name or its number; PETSC_FALSE if the text is neither.
   Not collective. */
PetscBool GmshNamesFindGroup(const GmshNames *names, PetscInt dim, const char group[], PetscInt *tag);
/* Whether a physical group of this dimension has this name. */
PetscBool GmshNamesHas(const GmshNames *names, PetscInt dim, const char name[]);
/* Appends "name (number)", or the number alone, to a list for a sentence. [in,out] text - [len] */
void GmshNamesDescribe(const GmshNames *names, PetscInt dim, PetscInt tag, char text[], size_t len);

/* Elements of first and second order, from lines to solids, their nodes and physical groups. */
typedef struct {
  PetscInt         num_nodes, num_elements, num_groups;
  PetscReal       *coords;      /* [num_nodes][3] */
  const GmshType **type;        /* [num_elements] */
  PetscInt        *start;       /* [num_elements+1] into nodes */
  PetscInt        *nodes;       /* indices in the order of element.h, of whose nodes the last may be missing */
  PetscInt        *first_group; /* into group [num_elements] */
  PetscInt        *end_group;   /* [num_elements] */
  PetscInt        *group;       /* numbers of physical groups [num_groups] */
} GmshMesh;

/* Physical groups with the same name become one, with the number of the first, as a loop over surfaces makes
   them by Gmsh's interface. Not collective. [in,out] mesh - groups of its elements */
void GmshNamesUnite(const GmshNames *names, GmshMesh *mesh);

/* Reads formats 2.2 and 4.1. Not collective.
   [out] reason - why the file cannot be used, "" if it can [len] */
PetscErrorCode GmshRead(const char path[], GmshNames *names, GmshMesh *mesh, char reason[], size_t len);
/* Highest dimension of the elements, found by their heads alone, up to the first solid; 0 if the file cannot
   be read. Not collective.
   [out] reason - "" if it can be read [len] */
PetscErrorCode GmshGetDimension(const char path[], PetscInt *dim, char reason[], size_t len);
PetscErrorCode GmshMeshDestroy(GmshMesh *mesh);

/* Checks the cells of a file: no element of a higher dimension, accepted types, different corners, a plane
   mesh in a plane. Not collective.
   [out] reason - why not, "" if so [len] */
PetscErrorCode GmshCheck(const GmshMesh *mesh, PetscInt dim, char reason[], size_t len);
/* Writes the sentence for a file whose cells have another dimension than the scene. [out] reason - [len] */
void GmshDescribeDimension(PetscInt highest, PetscInt dim, char reason[], size_t len);
/* Whether a mesh within these bounds is plane.
   [in] lower, upper - [3]; [out] reason - untouched if so [len] */
void GmshCheckHeight(const PetscReal lower[], const PetscReal upper[], char reason[], size_t len);
/* Corners of an element. */
PetscInt GmshNumCorners(const GmshMesh *mesh, PetscInt e);
/* Appends the corners of an element to a sentence: " (0, 0) (1, 0)". [in,out] text - [len] */
void GmshDescribeElement(const GmshMesh *mesh, PetscInt e, PetscInt dim, char text[], size_t len);

#endif
