// The kernel for x86 processors with AVX-512; called only where there is one.
#include "casting/sample_kernel.h"

// Tools that read this with clang know no such pragma.
#if defined(NACRE_KERNEL_AVX512) && !defined(__clang__)
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
#define NACRE_VECTOR_BYTES 64
#define NACRE_KERNEL samples_avx512
#include "casting/sample_kernel_body.h"
#endif
