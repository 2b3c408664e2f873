/* Numbers of twice the digits, and their functions. */
#ifndef FROT_EXTENDED_PRECISION_H
#define FROT_EXTENDED_PRECISION_H

#include <float.h>
#include <math.h>

/* Numbers of twice the digits, for what is lost beside large ones; where a compiler has none, the
 * widest it has. */
#ifdef __SIZEOF_FLOAT128__
typedef __float128 frot_wide;
#else
typedef long double frot_wide;
#endif

#ifdef __SIZEOF_FLOAT128__
#define FROT_WIDE_EPSILON ((frot_wide)0x1p-112)
#else
#define FROT_WIDE_EPSILON LDBL_EPSILON
#endif

/* The root: that of ordinary width and one step of Newton's. */
static inline frot_wide frot_wide_root(frot_wide x) {
  frot_wide near = sqrt((double)x);
  return near > 0 && near <= DBL_MAX ? (near + x / near) / 2 : near;
}

/* Of an angle known to ordinary width the sine and the cosine, of a direction that is one unit long
 * to the last digit: what is written out may rely on that. */
static inline frot_wide frot_wide_unit(double s, double c) {
  return (3 - ((frot_wide)s * s + (frot_wide)c * c)) / 2;
}
static inline frot_wide frot_wide_sine(frot_wide x) {
  double s = sin((double)x), c = cos((double)x);
  return frot_wide_unit(s, c) * s;
}
static inline frot_wide frot_wide_cosine(frot_wide x) {
  double s = sin((double)x), c = cos((double)x);
  return frot_wide_unit(s, c) * c;
}

#endif
