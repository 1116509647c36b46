#define DEM_TARGET sse2
#define DEM_NAME "sse2"
#define DEM_LANES Lanes4
#include "engine/texture/solver/kernels.inc"
