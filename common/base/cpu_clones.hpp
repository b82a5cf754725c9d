#pragma once

/// Before a function whose loops gain from wider vectors than every x86-64 machine has: it is
/// compiled twice, and the machine's own kind is taken when the program is loaded. For whole
/// numbers and for numbers worked out one by one: there the results are the same. Elsewhere, and
/// under sanitizers, which cannot bear it, it means nothing.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LIFELINE_ALSO_FOR_AVX2 __attribute__((target_clones("avx2", "default")))
#else
#define LIFELINE_ALSO_FOR_AVX2
#endif
