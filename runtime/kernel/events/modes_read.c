#include "events/modes_read.h"

static const frot_contact_mode *modes_of(const frot_model *m, const frot_state *s) {
  return (const void *)(s->data + frot_layout_of(m).modes);
}

static double *first_read(const frot_model *m, frot_state *s) {
  return s->data + frot_layout_of(m).d + m->n_conditions + m->n_contacts;
}

int frot_read_modes(const frot_model *m, frot_state *s, int *turned) {
  double *read = first_read(m, s);
  int changed = 0;
  for (int k = 0; k < m->n_modes; k++) {
    double mode = frot_mode_read(m, modes_of(m, s), k);
    int acts = k < m->n_felt && mode != read[k];
    read[k] = mode, changed |= acts;
    if (acts && m->mode_reads[k] == FROT_READS_CLOSED) *turned = m->mode_contact[k];
  }
  return changed;
}

void frot_expect_openings(const frot_model *m, frot_state *s) {
  const double *fired = s->data + frot_layout_of(m).fired;
  for (int k = 0; k < m->n_felt; k++) {
    int contact = m->mode_contact[k], closed = m->mode_reads[k] == FROT_READS_CLOSED;
    if (closed && fired[contact] != 0 && modes_of(m, s)[contact].closed) first_read(m, s)[k] = 0;
  }
}
