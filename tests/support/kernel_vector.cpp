#define VARIANT vector_kernel
#define VARIANT_NAME "vector"
#include "support/kernel_variant.inc"
