/* gmsh.h -- Gmsh files, read by Mortise itself.

   PETSc's reader takes references on trust, and knows neither cells without middle nodes in their facets nor cells of
   second order of two kinds in one file. */
#ifndef MORTISE_GMSH_H
#define MORTISE_GMSH_H

#include "gmsh/gmshtype.h"
#include <stdio.h>

/* Physical groups that have a name. */
typedef struct {
  PetscInt  num;
  PetscInt *dim, *tag; /* [num] */
  char    **name;      /* [num] */
} GmshNames;

PetscErrorCode GmshNamesDestroy(GmshNames *names);
/* The number of a physical group that the user gave by its name or its number; PETSC_FALSE if it can be neither. */
PetscBool GmshFindGroup(const GmshNames *names, PetscInt dim, const char group[], PetscInt *tag);
/* Whether a physical group of this dimension has this name. */
PetscBool GmshHasName(const GmshNames *names, PetscInt dim, const char name[]);
/* Appends "name (number)", or the number alone, to a list for a sentence. [in,out] text - [len] */
void GmshDescribeGroup(const GmshNames *names, PetscInt dim, PetscInt tag, char text[], size_t len);

/* Elements of first and second order, from lines to solids, and what they stand on. */
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

/* Reads formats 2.2 and 4.1. Not collective. [out] reason - why the file cannot be used, "" if it can [len] */
PetscErrorCode GmshRead(const char path[], GmshNames *names, GmshMesh *mesh, char reason[], size_t len);
PetscErrorCode GmshMeshDestroy(GmshMesh *mesh);

/* A file being read. The first thing that goes wrong sets `reason`; nothing is read after that. */
typedef struct {
  FILE      *file;
  PetscBool  binary;
  int        version, data_size; /* 10 times the format's, 22 or 41 */
  PetscInt64 size;               /* of the file in bytes: no count can be larger */
  char      *reason;             /* [len] */
  size_t     len;
  GmshMesh  *mesh;
  PetscInt   num_tags, *tag, *node;         /* sorted tags of nodes, and where the nodes are */
  PetscInt   num_entities, *entity, *place; /* sorted 4 * tag + dim, and place in the next two */
  PetscInt  *entity_first, *entity_end;     /* into mesh->group */
  PetscInt   max_groups, max_nodes;         /* that mesh->group and mesh->nodes have room for */
} GmshReader;

enum { GMSH_LINE = 512 }; /* longest line of text that is read as one */

/* Sets the reason unless there is one. */
void GmshReaderFail(GmshReader *reader, const char format[], ...);
/* The inside of $Entities (format 4.1), $Nodes, $Elements, behind the line of that name. */
PetscErrorCode GmshReadEntities(GmshReader *reader);
PetscErrorCode GmshReadNodes(GmshReader *reader);
PetscErrorCode GmshReadElements(GmshReader *reader);

#endif
