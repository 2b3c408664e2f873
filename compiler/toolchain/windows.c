/* What a Windows library without the start-up code of a C library lacks: its entry, the check of
 * the stack, and functions that the headers of MinGW promise beside those of Windows. Compiled
 * without built-in functions, so that none of these is made a call of itself. */

typedef __builtin_va_list arguments;

int DllMainCRTStartup(void *library, unsigned reason, void *reserved);
int vsnprintf(char *text, unsigned long long size, const char *format, arguments values);
int snprintf(char *text, unsigned long long size, const char *format, ...);
void sincos(double x, double *s, double *c);
int __fpclassify(double x);
int __isnan(double x);

/* Of Windows. */
__attribute__((dllimport)) int __stdio_common_vsprintf(unsigned long long options, char *text,
                                                       unsigned long long size, const char *format,
                                                       void *locale, arguments values);
double sin(double x);
double cos(double x);

#define AS_THE_STANDARD_SAYS 2 /* the length of the whole text is given, its part ends with NUL */

int _fltused = 0; /* what a linker looks for where numbers are computed with */

int DllMainCRTStartup(void *library, unsigned reason, void *reserved) {
  (void)library;
  (void)reason;
  (void)reserved;
  return 1;
}

/* A frame of rax bytes is about to be made: each page of it is touched in order, for Windows gives
 * out one page of the stack at a time. No register changes. */
__asm__(
    ".globl ___chkstk_ms\n"
    "___chkstk_ms:\n"
    "  pushq %rax\n"
    "  pushq %rcx\n"
    "  leaq 24(%rsp), %rcx\n" /* the stack of the caller */
    "1:cmpq $4096, %rax\n"
    "  jbe 2f\n"
    "  subq $4096, %rcx\n"
    "  testb $0, (%rcx)\n"
    "  subq $4096, %rax\n"
    "  jmp 1b\n"
    "2:subq %rax, %rcx\n"
    "  testb $0, (%rcx)\n"
    "  popq %rcx\n"
    "  popq %rax\n"
    "  ret\n");

int vsnprintf(char *text, unsigned long long size, const char *format, arguments values) {
  return __stdio_common_vsprintf(AS_THE_STANDARD_SAYS, text, size, format, 0, values);
}

int snprintf(char *text, unsigned long long size, const char *format, ...) {
  arguments values;
  __builtin_va_start(values, format);
  const int length = vsnprintf(text, size, format, values);
  __builtin_va_end(values);
  return length;
}

void sincos(double x, double *s, double *c) {
  *s = sin(x);
  *c = cos(x);
}

/* The answers are those of MinGW's math.h. */
int __fpclassify(double x) {
  union {
    double number;
    unsigned long long stored;
  } both = {x};
  const unsigned long long size = both.stored & 0x7FFFFFFFFFFFFFFFull;
  if (size > 0x7FF0000000000000ull) return 0x0100;  /* not a number */
  if (size == 0x7FF0000000000000ull) return 0x0500; /* infinite */
  if (size == 0) return 0x4000;                     /* zero */
  return size < 0x0010000000000000ull ? 0x4400 : 0x0400;
}

int __isnan(double x) { return x != x; }
