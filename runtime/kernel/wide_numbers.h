/* What is asked of wide numbers (records.h) beside their arithmetic. */
#ifndef FROT_WIDE_NUMBERS_H
#define FROT_WIDE_NUMBERS_H

#include <float.h>
#include <math.h>

#include "records.h"

#ifdef __SIZEOF_FLOAT128__
#define FROT_WIDE_EPSILON ((frot_wide)0x1p-112)
#else
#define FROT_WIDE_EPSILON LDBL_EPSILON
#endif

/* The root of a positive number: that of ordinary width and one step of Newton's. */
static inline frot_wide frot_wide_root(frot_wide x) {
  frot_wide near = sqrt((double)x);
  return (near + x / near) / 2;
}

#endif
