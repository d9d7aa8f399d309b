// The kernel for x86 processors with AVX-512 (F, BW, DQ, VL), and so BMI and
// POPCNT; called only where there is one.
#include "render/cpu/cluster_kernel.h"

// Tools that read this with clang know no such pragma.
#if defined(NACRE_KERNEL_AVX512) && !defined(__clang__)
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl,bmi,popcnt")
#define NACRE_VECTOR_BYTES 64
#define NACRE_KERNEL kernel_avx512
#include "render/cpu/cluster_kernel_body.h"
#endif
