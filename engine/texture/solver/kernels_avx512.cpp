#define DEM_TARGET avx512
#define DEM_NAME "avx512"
#define DEM_LANES Lanes8
#include "engine/texture/solver/kernels.inc"
