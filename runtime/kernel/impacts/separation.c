#include "impacts/separation.h"

#include "model/indexing.h"
#include "reactions/switching_functions.h"
#include "recording/event_log.h"

void frot_part_contact(const frot_model *m, frot_state *s, double t, int i,
                       frot_recorder *recorder) {
  frot_layout l = frot_layout_of(m);
  frot_contact_mode *modes = (void *)(s->data + l.modes);
  double *flight = frot_flight_of(s, &l, i);
  frot_record_settled_contacts(m, s, t, i, recorder);
  frot_record_event(recorder, s, t, FROT_EVENT_SEPARATION, i, frot_mode_value(m, modes, i),
                    FROT_MODE_OPEN, 1);
  frot_open(m, modes, i);
  frot_forget_guards(m, s, i, 1);
  for (int e = 0; e < m->n_elements; e++)
    if (m->elements[e].contact == i)
      frot_forget_guards(m, s, frot_element_guard(m, e), FROT_ELEMENT_GUARDS);
  flight[FROT_MET] = t, flight[FROT_HAS_MET] = 1;
}
