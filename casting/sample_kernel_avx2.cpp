// The kernel for x86 processors with AVX2; called only where there is one.
#include "casting/sample_kernel.h"

// Tools that read this with clang know no such pragma.
#if defined(NACRE_KERNEL_AVX2) && !defined(__clang__)
#pragma GCC target("avx2")
#define NACRE_VECTOR_BYTES 32
#define NACRE_KERNEL samples_avx2
#include "casting/sample_kernel_body.h"
#endif
