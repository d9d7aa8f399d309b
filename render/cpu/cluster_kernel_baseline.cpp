// The kernel for the instruction set that all processors of the architecture have.
#include "render/cpu/cluster_kernel.h"

#define NACRE_VECTOR_BYTES 16
#define NACRE_KERNEL kernel_baseline
#include "render/cpu/cluster_kernel_body.h"
