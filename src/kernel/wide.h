/* wide.h -- loops over real numbers in the width of the processor. */
#ifndef MORTISE_WIDE_H
#define MORTISE_WIDE_H

/* Before a function: the compiler makes a second version for processors with AVX2, and the dynamic linker
   chooses at the start of the program. Without it, loops use registers of two numbers, which all processors
   have. Sanitizers do not support such functions. */
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&                           \
    !defined(__SANITIZE_ADDRESS__)
#define MORTISE_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define MORTISE_WIDE
#endif

#endif
