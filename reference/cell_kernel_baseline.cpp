// The kernel for the instruction set that all processors of the architecture have.
#include "reference/cell_kernel.h"

#define NACRE_VECTOR_BYTES 16
#define NACRE_KERNEL cells_baseline
#include "reference/cell_kernel_body.h"
