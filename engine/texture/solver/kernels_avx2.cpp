#define DEM_TARGET avx2
#define DEM_NAME "avx2"
#define DEM_LANES Lanes4
#include "engine/texture/solver/kernels.inc"
