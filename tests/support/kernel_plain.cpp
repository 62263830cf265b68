#define FT_PLAIN
#define VARIANT plain_kernel
#define VARIANT_NAME "plain"
#include "support/kernel_variant.inc"
