/* fuzz.h -- what the targets share: MPI and PETSc begin once, and the input becomes a text.

   Each target is a function that must come back from every input whatsoever. clang's libFuzzer looks for inputs that it
   does not come back from (fuzz.sh); what was found stands in corpus/ and is played again by replay.c in every test run. */
#ifndef MORTISE_FUZZ_H
#define MORTISE_FUZZ_H

#include "base/compat.h"
#include "base/usererror.h"
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* What libFuzzer calls, and replay.c. */
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
  (void)argc, (void)argv;
  setenv("OMPI_MCA_opal_signal", "", 1);
  if (UserErrorInitialize() || PetscInitializeNoArguments() || PetscPopSignalHandler())
    abort(); // signals are the fuzzer's
  return 0;
}

/* A copy of the input with a zero behind it, to be freed; NULL where there is one within, which the readers refuse. */
static inline char *FuzzText(const uint8_t *data, size_t size)
{
  char *text = memchr(data, '\0', size) ? NULL : malloc(size + 1);

  if (text) {
    memcpy(text, data, size);
    text[size] = '\0';
  }
  return text;
}

/* A fault is the right answer to most inputs; any other error is what is looked for. */
static inline void FuzzExpect(PetscErrorCode code)
{
  if (code && code != MORTISE_ERR_USER) abort();
}

#endif
