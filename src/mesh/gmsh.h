/* gmsh.h -- what Mortise itself reads from a Gmsh file (private to the room). */
#ifndef MORTISE_GMSH_H
#define MORTISE_GMSH_H

#include <petscsys.h>
#include <stdio.h>

/* Physical groups that have a name. */
typedef struct {
  PetscInt  num;
  PetscInt *dim, *tag; /* [num] */
  char    **name;      /* [num] */
} GmshNames;

/* Reads names and checks what PETSc's reader takes on trust. Not collective.
   [out] version - 10 times the format's, 22 or 41; [out] reason - why the file cannot be used, "" if it can [len] */
PetscErrorCode GmshScan(const char path[], GmshNames *names, int *version, char reason[], size_t len);
PetscErrorCode GmshNamesDestroy(GmshNames *names);

/* The number of a physical group that the user gave by its name or its number; PETSC_FALSE if it can be neither. */
PetscBool GmshFindGroup(const GmshNames *names, PetscInt dim, const char group[], PetscInt *tag);
/* Appends "name (number)", or the number alone, to a list for a sentence. [in,out] text - [len] */
void GmshDescribeGroup(const GmshNames *names, PetscInt dim, PetscInt tag, char text[], size_t len);

/* A file being read. The first thing that goes wrong sets `reason`; nothing is read after that. */
typedef struct {
  FILE      *file;
  PetscBool  binary;
  int        version, data_size;
  PetscInt64 size;   /* of the file in bytes: no count can be larger */
  char      *reason; /* [len] */
  size_t     len;
  PetscInt   num_nodes, num_entities, *nodes, *entities; /* sorted tags; entities as 4 * tag + dim */
} GmshReader;

enum { GMSH_LINE = 512 }; /* longest line of text that is read as one */

/* Sets the reason unless there is one. */
void GmshReaderFail(GmshReader *reader, const char format[], ...);
/* The inside of $Entities (format 4.1), $Nodes, $Elements, behind the line of that name. */
PetscErrorCode GmshCheckEntities(GmshReader *reader);
PetscErrorCode GmshCheckNodes(GmshReader *reader);
PetscErrorCode GmshCheckElements(GmshReader *reader);

#endif
