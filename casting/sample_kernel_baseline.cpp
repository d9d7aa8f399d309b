// The kernel for the instruction set that all processors of the architecture have.
#include "casting/sample_kernel.h"

#define NACRE_VECTOR_BYTES 16
#define NACRE_KERNEL samples_baseline
#include "casting/sample_kernel_body.h"
