#define DEM_TARGET wide
#define DEM_NAME "wide"
#define DEM_LANES Lanes8
#include "engine/texture/solver/kernels.inc"
