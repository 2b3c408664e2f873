/* Saved states: one flat block of a head and the kernel's state, fit for copying and for a file. */
#include "instance.h"

#include <stdlib.h>
#include <string.h>

#define VERSION 4u

static const char MAGIC[8] = {'F', 'r', 'o', 't', 'F', 'M', 'U', '\0'};

typedef struct {
  char magic[8];
  unsigned version;
  unsigned head_size;
  unsigned long long size;     /* of head and state */
  unsigned long long checksum; /* of all that follows */
  frot_fmu_life life;
  int unsettled; /* values were set and have not taken effect */
  int reserved;
} head;

/* The state behind the head is aligned like memory of the allocator. */
#define ALIGNED(n) (((n) + 15u) / 16u * 16u)
#define HEAD ALIGNED(sizeof(head))
#define LINK ALIGNED(sizeof(frot_fmu_snapshot))

struct frot_fmu_snapshot {
  frot_fmu_snapshot *next;
};

static unsigned char *content(frot_fmu_snapshot *snapshot) {
  return (unsigned char *)snapshot + LINK;
}

static size_t content_size(const frot_fmu *fmu) { return HEAD + fmu->state_size; }

/* FNV-1a (Fowler, Noll, Vo), 64 bits: finds damage, not malice. */
static unsigned long long checksum(const unsigned char *bytes, size_t size) {
  const size_t first = offsetof(head, life);
  unsigned long long hash = 14695981039346656037ull;
  for (size_t i = first; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211ull;
  return hash;
}

static frot_fmu_snapshot *new_snapshot(frot_fmu *fmu) {
  frot_fmu_snapshot *snapshot = frot_fmu_memory(LINK + content_size(fmu));
  if (snapshot != NULL) {
    snapshot->next = fmu->snapshots;
    fmu->snapshots = snapshot;
  }
  return snapshot;
}

/* A handle is looked up, never followed: what the environment hands over may be anything. */
static frot_fmu_snapshot *find(const frot_fmu *fmu, const char *function, const void *handle) {
  frot_fmu_snapshot *snapshot = fmu->snapshots;
  while (snapshot != NULL && snapshot != handle) snapshot = snapshot->next;
  if (snapshot == NULL)
    frot_fmu_say(fmu, FROT_FMU_ERROR,
                 "%s: this is not a saved state of this instance; a state goes to another instance "
                 "serialized.",
                 function);
  return snapshot;
}

static void unlink_snapshot(frot_fmu *fmu, frot_fmu_snapshot *snapshot) {
  frot_fmu_snapshot **link = &fmu->snapshots;
  while (*link != snapshot) link = &(*link)->next;
  *link = snapshot->next;
  free(snapshot);
}

int frot_fmu_save(frot_fmu *fmu, const char *function, void **handle) {
  frot_fmu_snapshot *snapshot;
  head top;
  if (handle == NULL) return frot_fmu_refuse(fmu, function, "the pointer to the state is NULL");
  if (frot_fmu_is_called(fmu)) return frot_fmu_misplaced(fmu, function);
  if (*handle != NULL) {
    snapshot = find(fmu, function, *handle);
    if (snapshot == NULL) return FROT_FMU_ERROR;
  } else {
    snapshot = new_snapshot(fmu);
    if (snapshot == NULL) return frot_fmu_refuse(fmu, function, "there is not enough memory");
  }
  memset(&top, 0, sizeof top);
  memcpy(top.magic, MAGIC, sizeof MAGIC);
  top.version = VERSION;
  top.head_size = (unsigned)HEAD;
  top.size = content_size(fmu);
  top.life = fmu->life;
  top.unsettled = fmu->unsettled != FROT_FMU_SETTLED;
  memcpy(content(snapshot), &top, sizeof top);
  memcpy(content(snapshot) + HEAD, fmu->state, fmu->state_size);
  *handle = snapshot;
  return FROT_FMU_OK;
}

/* The state may come from an instance of the other kind. */
static void adopt_phase(frot_fmu *fmu) {
  frot_fmu_life *life = &fmu->life;
  if (fmu->exchanges && life->phase == FROT_FMU_STEPPING) {
    frot_exchange_read(fmu->model, fmu->state, fmu->states);
    frot_exchange_place(fmu->model, fmu->state, fmu->work, life->t, fmu->states);
    life->phase = FROT_FMU_EVENT, life->moved = 0;
  } else if (!fmu->exchanges && (life->phase == FROT_FMU_CONTINUOUS ||
                                 (life->phase == FROT_FMU_EVENT && !fmu->watches_events))) {
    life->phase = FROT_FMU_STEPPING;
  }
}

int frot_fmu_restore(frot_fmu *fmu, const char *function, void *handle) {
  head top;
  frot_fmu_snapshot *snapshot = find(fmu, function, handle);
  if (snapshot == NULL) return FROT_FMU_ERROR;
  if (frot_fmu_is_called(fmu)) return frot_fmu_misplaced(fmu, function);
  memcpy(&top, content(snapshot), sizeof top);
  memcpy(fmu->state, content(snapshot) + HEAD, fmu->state_size);
  fmu->life = top.life;
  adopt_phase(fmu);
  fmu->unsettled = top.unsettled ? FROT_FMU_RESTORED : FROT_FMU_SETTLED;
  fmu->values_valid = fmu->motion_valid = 0;
  return FROT_FMU_OK;
}

int frot_fmu_drop(frot_fmu *fmu, const char *function, void **handle) {
  if (handle == NULL || *handle == NULL) return FROT_FMU_OK;
  frot_fmu_snapshot *snapshot = find(fmu, function, *handle);
  if (snapshot == NULL) return FROT_FMU_ERROR;
  unlink_snapshot(fmu, snapshot);
  *handle = NULL;
  return FROT_FMU_OK;
}

void frot_fmu_drop_all(frot_fmu *fmu) {
  while (fmu->snapshots != NULL) unlink_snapshot(fmu, fmu->snapshots);
}

int frot_fmu_serialized_size(frot_fmu *fmu, const char *function, void *handle, size_t *size) {
  if (size == NULL) return frot_fmu_refuse(fmu, function, "the pointer to the size is NULL");
  if (find(fmu, function, handle) == NULL) return FROT_FMU_ERROR;
  *size = content_size(fmu);
  return FROT_FMU_OK;
}

int frot_fmu_serialize(frot_fmu *fmu, const char *function, void *handle, void *bytes,
                       size_t size) {
  head top;
  frot_fmu_snapshot *snapshot = find(fmu, function, handle);
  if (snapshot == NULL) return FROT_FMU_ERROR;
  if (bytes == NULL) return frot_fmu_refuse(fmu, function, "the array of bytes is NULL");
  if (size < content_size(fmu))
    return frot_fmu_say(fmu, FROT_FMU_ERROR, "%s: the state takes %lu bytes, the array has %lu.",
                        function, (unsigned long)content_size(fmu), (unsigned long)size);
  memcpy(&top, content(snapshot), sizeof top);
  top.checksum = checksum(content(snapshot), content_size(fmu));
  memcpy(content(snapshot), &top, sizeof top);
  memcpy(bytes, content(snapshot), content_size(fmu));
  return FROT_FMU_OK;
}

/* NULL, or why the bytes are not a state of this model. */
static const char *objection(const frot_fmu *fmu, const unsigned char *bytes) {
  head top;
  memcpy(&top, bytes, sizeof top);
  if (memcmp(top.magic, MAGIC, sizeof MAGIC) != 0) return "the bytes are not a saved state";
  if (top.version != VERSION || top.head_size != HEAD)
    return "the state was saved by another version of Frot";
  if (top.size != content_size(fmu)) return "the state is of another model";
  if (top.checksum != checksum(bytes, content_size(fmu))) return "the bytes are damaged";
  if (top.life.phase < FROT_FMU_INSTANTIATED || top.life.phase > FROT_FMU_CONTINUOUS ||
      !frot_state_valid(fmu->model, bytes + HEAD, fmu->state_size))
    return "the state is of another model";
  return NULL;
}

int frot_fmu_deserialize(frot_fmu *fmu, const char *function, const void *bytes, size_t size,
                         void **handle) {
  if (bytes == NULL || handle == NULL)
    return frot_fmu_refuse(fmu, function, "the bytes or the pointer to the state are NULL");
  if (size != content_size(fmu))
    return frot_fmu_say(fmu, FROT_FMU_ERROR,
                        "%s: a state of this model takes %lu bytes, there are %lu.", function,
                        (unsigned long)content_size(fmu), (unsigned long)size);
  frot_fmu_snapshot *former = NULL;
  if (*handle != NULL && (former = find(fmu, function, *handle)) == NULL) return FROT_FMU_ERROR;
  frot_fmu_snapshot *snapshot = new_snapshot(fmu);
  if (snapshot == NULL) return frot_fmu_refuse(fmu, function, "there is not enough memory");
  memcpy(content(snapshot), bytes, size);
  const char *reason = objection(fmu, content(snapshot));
  if (reason != NULL) {
    unlink_snapshot(fmu, snapshot);
    return frot_fmu_refuse(fmu, function, reason);
  }
  if (former != NULL) unlink_snapshot(fmu, former);
  *handle = snapshot;
  return FROT_FMU_OK;
}
