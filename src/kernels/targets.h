// Which instruction sets a loop on the CPU is compiled for; the best one is chosen when the program starts.
#pragma once

// Contraction is off everywhere, so all versions give the same bits. Sanitizers run before the choice can be made.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(WINDFALL_SANITIZED) && defined(__OPTIMIZE__)
#define WINDFALL_TARGETS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), optimize("O3")))
#else
#define WINDFALL_TARGETS
#endif
