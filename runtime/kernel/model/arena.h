/* Pieces of one block of memory, handed out one after the other. */
#ifndef FROT_ARENA_H
#define FROT_ARENA_H

#include <stddef.h>

/* Under the address sanitizer a gap behind each piece in which nobody may read or write. */
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#define FROT_ARENA_GAP 64
#else
#define FROT_ARENA_GAP 0
#define ASAN_POISON_MEMORY_REGION(from, size) ((void)(from), (void)(size))
#endif

typedef struct {
  char *base;  /* of the block; NULL: the pieces are only counted */
  size_t used; /* bytes handed out */
} frot_arena;

/* The next piece, aligned to 16 bytes: `count` items of `size` bytes. NULL while counting. */
static inline void *frot_take(frot_arena *a, size_t count, size_t size) {
  size_t at = (a->used + 15) & ~(size_t)15, end = at + count * size;
  a->used = end + (FROT_ARENA_GAP > 0 ? FROT_ARENA_GAP : size);
  if (!a->base) return NULL;
  ASAN_POISON_MEMORY_REGION(a->base + end, FROT_ARENA_GAP);
  return a->base + at;
}

/* field <- `count` items of its type, from the arena `a`. */
#define FROT_TAKE(a, field, count) (field = frot_take(a, (size_t)(count), sizeof *field))

#endif
