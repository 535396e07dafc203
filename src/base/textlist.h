/* textlist.h -- lists of texts before PETSc begins. */
#ifndef BASE_TEXTLIST_H
#define BASE_TEXTLIST_H

#include <stddef.h>

/* Texts in the order they came, ended by NULL, owned. */
typedef struct {
  int    num;
  char **items;
} TextList;

/* realloc() that ends the program where memory is out. */
void *TextListAllocate(void *old, size_t size);
/* Appends a copy. Not collective. */
void TextListAppend(TextList *list, const char text[]);
void TextListClear(TextList *list);
/* The first rank's list, everywhere. Collective on MPI_COMM_WORLD. */
void TextListBroadcast(TextList *list);

#endif
