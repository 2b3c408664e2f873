/* Arithmetic of IEEE 754 binary128 numbers, rounded to nearest, under the names that compilers
 * call.
 *
 * For libraries that are linked without the compiler's own: that of ziglang would bring functions
 * of mathematics along, in the place of those of the system that a library runs on. */

#ifdef __SIZEOF_FLOAT128__
typedef __float128 quad;
#else
typedef long double quad;
#endif
typedef unsigned __int128 bits;

#define FRACTION 112 /* bits of a fraction; the leading one of a normal number is not stored */
#define MOST 0x7FFF  /* the exponent of infinity and of what is not a number */
#define BIAS 0x3FFF
#define EXTRA 3 /* bits below the last, of which the lowest is set where any below it is */
#define ONE ((bits)1)
#define LEADING (ONE << FRACTION)
#define SIGN (ONE << 127)
#define INFINITE ((bits)MOST << FRACTION)
#define QUIET (INFINITE | (LEADING >> 1))

quad __addtf3(quad a, quad b);
quad __subtf3(quad a, quad b);
quad __multf3(quad a, quad b);
quad __divtf3(quad a, quad b);
quad __extenddftf2(double x);
double __trunctfdf2(quad x);
quad __floatsitf(int n);
quad __floatditf(long long n);
quad __floatunsitf(unsigned n);
quad __floatunditf(unsigned long long n);
long long __unordtf2(quad a, quad b);
long long __eqtf2(quad a, quad b);
long long __netf2(quad a, quad b);
long long __lttf2(quad a, quad b);
long long __letf2(quad a, quad b);
long long __gttf2(quad a, quad b);
long long __getf2(quad a, quad b);

static bits to_bits(quad x) {
  union {
    quad number;
    bits stored;
  } both = {x};
  return both.stored;
}

static quad to_quad(bits x) {
  union {
    bits stored;
    quad number;
  } both = {x};
  return both.number;
}

static bits magnitude(bits x) { return x & ~SIGN; }

static int is_nan(bits x) { return magnitude(x) > INFINITE; }

/* To the right, the lowest bit set where a bit is lost. */
static bits shift(bits x, int by) {
  if (by <= 0) return x;
  if (by > 127) return x != 0;
  return x >> by | ((x & ((ONE << by) - 1)) != 0);
}

/* A finite number: its fraction with the leading bit, and its exponent, 1 for a subnormal one. */
static bits fraction_of(bits x, int *exponent) {
  const int stored = (int)(magnitude(x) >> FRACTION);
  *exponent = stored > 0 ? stored : 1;
  return (x & (LEADING - 1)) | (stored > 0 ? LEADING : 0);
}

/* The same of a number that is not zero, with the leading bit in its place. */
static bits normal(bits x, int *exponent) {
  bits m = fraction_of(x, exponent);
  for (; m < LEADING; m <<= 1) --*exponent;
  return m;
}

/* The number nearest to m, of EXTRA bits more than a fraction, as a multiple of its last place. */
static bits nearest(bits m) {
  const unsigned rest = (unsigned)m & 7u;
  m >>= EXTRA;
  return m + (rest > 4 || (rest == 4 && (m & 1)));
}

/* m has its leading bit in place, EXTRA bits further left, or the exponent 1. */
static quad packed(bits sign, int exponent, bits m) {
  if (exponent >= MOST) return to_quad(sign | INFINITE);
  if (exponent < 1) {
    m = shift(m, 1 - exponent);
    exponent = 1;
  }
  /* The leading bit, and a carry of rounding, count one exponent up. */
  return to_quad(sign | ((((bits)(unsigned)(exponent - 1)) << FRACTION) + nearest(m)));
}

/* For |x| >= |y|, neither infinite nor not a number. */
static quad sum(bits x, bits y) {
  int above, below;
  bits m = fraction_of(x, &above) << EXTRA;
  const bits other = fraction_of(y, &below) << EXTRA;
  if (((x ^ y) & SIGN) == 0) {
    m += shift(other, above - below);
    if (m >> (FRACTION + EXTRA + 1)) {
      m = shift(m, 1);
      above++;
    }
    return packed(x & SIGN, above, m);
  }
  m -= shift(other, above - below);
  if (m == 0) return to_quad(0);
  for (; m < LEADING << EXTRA && above > 1; m <<= 1) above--;
  return packed(x & SIGN, above, m);
}

quad __addtf3(quad a, quad b) {
  const bits x = to_bits(a), y = to_bits(b);
  if (is_nan(x) || is_nan(y)) return to_quad(QUIET);
  if (magnitude(x) == INFINITE || magnitude(y) == INFINITE) {
    if (magnitude(x) == magnitude(y) && x != y) return to_quad(QUIET);
    return magnitude(x) == INFINITE ? a : b;
  }
  if (magnitude(x) == 0 && magnitude(y) == 0) return to_quad(x & y);
  return magnitude(x) >= magnitude(y) ? sum(x, y) : sum(y, x);
}

quad __subtf3(quad a, quad b) {
  return is_nan(to_bits(b)) ? to_quad(QUIET) : __addtf3(a, to_quad(to_bits(b) ^ SIGN));
}

/* The upper bits of x times y, of 113 bits each, from bit 109 on, the lowest set for any below. */
static bits product(bits x, bits y) {
  const bits low = ~0ull;
  const bits a = x >> 64, b = x & low, c = y >> 64, d = y & low;
  const bits last = b * d, middle = a * d + (last >> 64), inner = b * c + (middle & low);
  const bits under = inner << 64 | (last & low), over = a * c + (middle >> 64) + (inner >> 64);
  return over << 19 | under >> 109 | ((under & ((ONE << 109) - 1)) != 0);
}

quad __multf3(quad a, quad b) {
  const bits x = to_bits(a), y = to_bits(b), sign = (x ^ y) & SIGN;
  int first, second;
  if (is_nan(x) || is_nan(y)) return to_quad(QUIET);
  if (magnitude(x) == INFINITE || magnitude(y) == INFINITE)
    return to_quad(magnitude(x) == 0 || magnitude(y) == 0 ? QUIET : sign | INFINITE);
  if (magnitude(x) == 0 || magnitude(y) == 0) return to_quad(sign);
  const bits m = product(normal(x, &first), normal(y, &second));
  const int carried = (int)(m >> (FRACTION + EXTRA + 1));
  return packed(sign, first + second - BIAS + carried, carried ? shift(m, 1) : m);
}

quad __divtf3(quad a, quad b) {
  const bits x = to_bits(a), y = to_bits(b), sign = (x ^ y) & SIGN;
  int first, second;
  if (is_nan(x) || is_nan(y)) return to_quad(QUIET);
  if (magnitude(x) == INFINITE) return to_quad(magnitude(y) == INFINITE ? QUIET : sign | INFINITE);
  if (magnitude(y) == 0) return to_quad(magnitude(x) == 0 ? QUIET : sign | INFINITE);
  if (magnitude(x) == 0 || magnitude(y) == INFINITE) return to_quad(sign);
  bits rest = normal(x, &first), quotient = 0;
  const bits divisor = normal(y, &second);
  if (rest < divisor) {
    rest <<= 1;
    first--;
  }
  for (int i = 0; i <= FRACTION + EXTRA; i++) {
    quotient <<= 1;
    if (rest >= divisor) {
      rest -= divisor;
      quotient |= 1;
    }
    rest <<= 1;
  }
  return packed(sign, first - second + BIAS, quotient | (rest != 0));
}

quad __extenddftf2(double x) {
  union {
    double number;
    unsigned long long stored;
  } both = {x};
  const bits sign = (bits)(both.stored >> 63) << 127;
  bits m = (bits)(both.stored & 0xFFFFFFFFFFFFFull) << 60;
  int exponent = (int)(both.stored >> 52 & 0x7FF);
  if (exponent == 0x7FF) return to_quad(m == 0 ? sign | INFINITE : QUIET);
  if (exponent == 0 && m == 0) return to_quad(sign);
  if (exponent > 0)
    return to_quad(sign | ((bits)(unsigned)(exponent - 1023 + BIAS) << FRACTION) | m);
  for (exponent = 1; m < LEADING; m <<= 1) exponent--;
  return to_quad(sign | (((bits)(unsigned)(exponent - 1023 + BIAS - 1) << FRACTION) + m));
}

double __trunctfdf2(quad x) {
  const bits stored = to_bits(x);
  union {
    unsigned long long stored;
    double number;
  } both = {(unsigned long long)(stored >> 127) << 63};
  int exponent;
  if (magnitude(stored) >= INFINITE) {
    both.stored |= 0x7FF0000000000000ull | (is_nan(stored) ? 0x8000000000000ull : 0);
    return both.number;
  }
  bits m = shift(fraction_of(stored, &exponent), FRACTION - 52 - EXTRA);
  exponent -= BIAS - 1023;
  if (exponent >= 0x7FF) {
    both.stored |= 0x7FF0000000000000ull;
    return both.number;
  }
  if (exponent < 1) {
    m = shift(m, 1 - exponent);
    exponent = 1;
  }
  both.stored |= ((unsigned long long)(exponent - 1) << 52) + (unsigned long long)nearest(m);
  return both.number;
}

static quad whole(bits sign, unsigned long long n) {
  int exponent = BIAS + FRACTION;
  bits m = n;
  if (n == 0) return to_quad(0);
  for (; m < LEADING; m <<= 1) exponent--;
  return to_quad(sign | (((bits)(unsigned)(exponent - 1) << FRACTION) + m));
}

quad __floatunditf(unsigned long long n) { return whole(0, n); }
quad __floatunsitf(unsigned n) { return whole(0, n); }
quad __floatditf(long long n) {
  return n < 0 ? whole(SIGN, 0 - (unsigned long long)n) : whole(0, (unsigned long long)n);
}
quad __floatsitf(int n) { return __floatditf(n); }

/* -1, 0 or 1 as a is below b, equal or above, and `unordered` where either is not a number. */
static long long compared(bits a, bits b, long long unordered) {
  if (is_nan(a) || is_nan(b)) return unordered;
  if (a == b || (magnitude(a) | magnitude(b)) == 0) return 0;
  if ((a ^ b) & SIGN) return a & SIGN ? -1 : 1;
  return (a < b) == !(a & SIGN) ? -1 : 1;
}

long long __unordtf2(quad a, quad b) { return is_nan(to_bits(a)) || is_nan(to_bits(b)); }
long long __eqtf2(quad a, quad b) { return compared(to_bits(a), to_bits(b), 1); }
long long __netf2(quad a, quad b) { return compared(to_bits(a), to_bits(b), 1); }
long long __lttf2(quad a, quad b) { return compared(to_bits(a), to_bits(b), 1); }
long long __letf2(quad a, quad b) { return compared(to_bits(a), to_bits(b), 1); }
long long __gttf2(quad a, quad b) { return compared(to_bits(a), to_bits(b), -1); }
long long __getf2(quad a, quad b) { return compared(to_bits(a), to_bits(b), -1); }
