/* mutate.h -- changes of texts for libFuzzer, word by word and line by line, and the random numbers they need. */
#ifndef MORTISE_MUTATE_H
#define MORTISE_MUTATE_H

#include <stddef.h>
#include <stdint.h>

/* What libFuzzer calls in place of its own changes, and these. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);

void RandomSeed(unsigned seed);
/* 0 .. end - 1; 0 where there is nothing to choose from. */
int Random(int end);
/* Small, or one of those at which programs break. */
int RandomInteger(void);

/* Changes one word or line: another one of the text, a number, once more, away. Returns the new size. */
size_t MutateText(uint8_t *data, size_t size, size_t max_size);

#endif
