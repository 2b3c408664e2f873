/* Compares binary128.c with the compiler's own arithmetic, bit by bit, on random numbers. The first
 * argument is the seed, the second how many pairs. Ends with 0 if no result differs. */
#define __addtf3 own_add
#define __subtf3 own_sub
#define __multf3 own_mul
#define __divtf3 own_div
#define __extenddftf2 own_extend
#define __trunctfdf2 own_truncate
#define __floatsitf own_of_int
#define __floatditf own_of_long
#define __floatunsitf own_of_unsigned
#define __floatunditf own_of_unsigned_long
#define __unordtf2 own_unordered
#define __eqtf2 own_equal
#define __netf2 own_unequal
#define __lttf2 own_less
#define __letf2 own_at_most
#define __gttf2 own_greater
#define __getf2 own_at_least
#include "binary128.c"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned long long seed;

static unsigned long long word(void) {
  seed ^= seed << 13;
  seed ^= seed >> 7;
  seed ^= seed << 17;
  return seed;
}

/* Numbers of all sizes, close ones, short ones, zeros, infinities and what is not a number. */
static bits number(bits near) {
  bits x = (bits)word() << 64 | word();
  switch (word() % 12) {
    case 0:
      return x & SIGN;
    case 1:
      return (x & SIGN) | INFINITE;
    case 2:
      return word() % 4 ? x & ~INFINITE : x | INFINITE;
    case 3:
      return x & ~(~(bits)0 >> (8 + word() % 112));
    case 4:
    case 5:
      return near ^ (x & ((ONE << word() % 120) - 1));
    case 6:
    case 7:
      return near + ((bits)(word() % 9) << FRACTION) - ((bits)4 << FRACTION);
    case 8:
    case 9: /* of the size of a double */
      return (x & ~INFINITE) | (bits)(BIAS - 1090 + word() % 2180) << FRACTION;
    default:
      return x;
  }
}

static void same(const char *what, quad own, quad expected, bits x, bits y) {
  const bits a = to_bits(own), b = to_bits(expected);
  if (a == b || (is_nan(a) && is_nan(b))) return;
  fprintf(stderr, "%s of %016llx%016llx and %016llx%016llx: %016llx%016llx, not %016llx%016llx\n",
          what, (unsigned long long)(x >> 64), (unsigned long long)x, (unsigned long long)(y >> 64),
          (unsigned long long)y, (unsigned long long)(a >> 64), (unsigned long long)a,
          (unsigned long long)(b >> 64), (unsigned long long)b);
  exit(1);
}

static void agree(const char *what, int own, int expected, bits x, bits y) {
  if (own != expected) same(what, own, expected, x, y);
}

static void compare(bits x, bits y) {
  const quad a = to_quad(x), b = to_quad(y);
  const double narrow = own_truncate(a), expected = (double)a;
  same("sum", own_add(a, b), a + b, x, y);
  same("difference", own_sub(a, b), a - b, x, y);
  same("product", own_mul(a, b), a * b, x, y);
  same("quotient", own_div(a, b), a / b, x, y);
  if (!is_nan(x) && memcmp(&narrow, &expected, sizeof narrow) != 0)
    same("truncation", (quad)narrow, (quad)expected, x, x);
  same("extension", own_extend(expected), (quad)expected, x, x);
  same("integer", own_of_int((int)x), (quad)(int)x, x, x);
  same("long integer", own_of_long((long long)x), (quad)(long long)x, x, x);
  same("unsigned", own_of_unsigned((unsigned)x), (quad)(unsigned)x, x, x);
  same("long unsigned", own_of_unsigned_long((unsigned long long)x), (quad)(unsigned long long)x, x,
       x);
  agree("unordered", own_unordered(a, b) != 0, __builtin_isunordered(a, b), x, y);
  agree("equal", own_equal(a, b) == 0, a == b, x, y);
  agree("unequal", own_unequal(a, b) != 0, a != b, x, y);
  agree("less", own_less(a, b) < 0, a < b, x, y);
  agree("at most", own_at_most(a, b) <= 0, a <= b, x, y);
  agree("greater", own_greater(a, b) > 0, a > b, x, y);
  agree("at least", own_at_least(a, b) >= 0, a >= b, x, y);
}

int main(int count, char **arguments) {
  if (count != 3) return 2;
  seed = strtoull(arguments[1], NULL, 10);
  bits x = 0;
  for (long long i = atoll(arguments[2]); i > 0; i--) {
    const bits y = number(x);
    compare(x, y);
    x = y;
  }
  return 0;
}
