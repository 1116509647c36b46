#pragma once
// Vectors of doubles for the hot loops, one lane a contact. To be included before vector_math.h: the templates there find
// root() and select() by plain look-up.
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace dem::texture {

/// Four and eight contacts at a time. A mask is the vector of integers that a comparison gives.
typedef double Lanes4 __attribute__((vector_size(32)));
typedef double Lanes8 __attribute__((vector_size(64)));
typedef long Mask4 __attribute__((vector_size(32)));
typedef long Mask8 __attribute__((vector_size(64)));

inline __attribute__((always_inline)) Lanes4 root(Lanes4 a) {
#ifdef __AVX__
  return _mm256_sqrt_pd(a);
#else
  for (int lane = 0; lane < 4; ++lane) a[lane] = __builtin_sqrt(a[lane]);
  return a;
#endif
}
inline __attribute__((always_inline)) Lanes8 root(Lanes8 a) {
#ifdef __AVX512F__
  return _mm512_sqrt_pd(a);
#else
  for (int lane = 0; lane < 8; ++lane) a[lane] = __builtin_sqrt(a[lane]);
  return a;
#endif
}
inline __attribute__((always_inline)) Lanes4 select(Mask4 mask, Lanes4 yes, Lanes4 no) { return mask ? yes : no; }
inline __attribute__((always_inline)) Lanes8 select(Mask8 mask, Lanes8 yes, Lanes8 no) { return mask ? yes : no; }
/// Whether the mask holds in some lane.
inline __attribute__((always_inline)) bool any(Mask4 mask) {
#ifdef __AVX__
  return _mm256_testz_si256(reinterpret_cast<__m256i>(mask), reinterpret_cast<__m256i>(mask)) == 0;
#else
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}
inline __attribute__((always_inline)) bool any(Mask8 mask) {
#ifdef __AVX512F__
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask)) != 0;
#else
  return ((mask[0] | mask[1] | mask[2] | mask[3]) | (mask[4] | mask[5] | mask[6] | mask[7])) != 0;
#endif
}

}  // namespace dem::texture
