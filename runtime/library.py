"""The calls and structures of the C kernel (kernel/frot.h) for ctypes."""

from __future__ import annotations

import ctypes as ct
import functools
from pathlib import Path

from frot.dsl.messages.errors import fail


class Options(ct.Structure):
    """The C struct `frot_options`."""

    _fields_ = (
        ("tolerance", ct.c_double),
        ("on_indeterminate", ct.c_int),
        ("on_impasse", ct.c_int),
    )


class RawEvent(ct.Structure):
    """The C struct `frot_event`."""

    _fields_ = (
        ("t", ct.c_double),
        ("kind", ct.c_int),
        ("contact", ct.c_int),
        ("before", ct.c_int),
        ("after", ct.c_int),
        ("solutions", ct.c_int),
        ("together", ct.c_int),
        ("element", ct.c_int),
        ("impulse", ct.c_double),
        ("lost", ct.c_double),
        ("until", ct.c_double),
        ("vector", ct.c_double * 3),
    )


class Recorder(ct.Structure):
    """The C struct `frot_recorder`."""

    _fields_ = (
        ("segments", ct.c_void_p),
        ("segment_capacity", ct.c_longlong),
        ("segment_used", ct.c_longlong),
        ("events", ct.POINTER(RawEvent)),
        ("event_capacity", ct.c_longlong),
        ("event_count", ct.c_longlong),
        ("last", ct.c_longlong),
        ("whole", ct.c_longlong),
        ("naps", ct.c_longlong),
        ("drain", ct.c_void_p),
        ("context", ct.c_void_p),
        ("lost", ct.c_longlong),
    )


class Fault(ct.Structure):
    """The C struct `frot_fault`."""

    _fields_ = (
        ("status", ct.c_int),
        ("contact", ct.c_int),
        ("item", ct.c_int),
        ("other", ct.c_int),
        ("t", ct.c_double),
        ("value", ct.c_double),
        ("where", ct.c_double * 3),
    )


class Statistics(ct.Structure):
    """frot_statistics: counts of a run."""

    _fields_ = (
        ("steps", ct.c_longlong),
        ("rejected", ct.c_longlong),
        ("evaluations", ct.c_longlong),
        ("events", ct.c_longlong),
        ("implicit_steps", ct.c_longlong),
        ("jacobians", ct.c_longlong),
        ("unsearched", ct.c_longlong),
        ("blurred", ct.c_double),
        ("crossings", ct.c_longlong),
        ("free", ct.c_longlong),
        ("masked", ct.c_double),
        ("lost", ct.c_double),
        ("lost_state", ct.c_longlong),
        ("springs", ct.c_longlong),
        ("spring", ct.c_longlong),
    )


_DOUBLES, _BYTES = ct.POINTER(ct.c_double), ct.POINTER(ct.c_byte)


class RawMotion(ct.Structure):
    """The C struct `frot_motion`."""

    _fields_ = (
        ("part", ct.c_int),
        ("order", ct.c_int),
        ("decided", ct.c_int),
        ("family", ct.c_int),
        ("hardly", ct.c_int),
        ("same", ct.c_int),
        ("a", _DOUBLES),
        ("lam", _DOUBLES),
        ("acceleration", _DOUBLES),
        ("painleve", _DOUBLES),
        ("direction", _DOUBLES),
        ("values", _DOUBLES),
        ("contact", _BYTES),
        ("element", _BYTES),
        ("since", _BYTES),
    )


class MotionsFound(ct.Structure):
    """The C struct `frot_motions_found`."""

    _fields_ = (
        ("n_parts", ct.c_int),
        ("count", ct.c_int),
        ("complete", ct.c_int),
        ("proved", ct.c_int),
        ("highest", ct.c_int),
        ("nodes", ct.c_int),
        ("motions", ct.POINTER(RawMotion)),
        ("contacts", _BYTES),
        ("part_of_contact", ct.POINTER(ct.c_int)),
    )


Monitor = ct.CFUNCTYPE(ct.c_int, ct.c_void_p, ct.c_double)
Drain = ct.CFUNCTYPE(None, ct.POINTER(Recorder), ct.c_void_p)
_POINTER, _DOUBLE, _INT, _LONG = ct.c_void_p, ct.c_double, ct.c_int, ct.c_longlong
_SIGNATURES: dict[str, tuple[object, tuple[object, ...]]] = {
    "frot_state_size": (ct.c_size_t, (_POINTER,)),
    "frot_work_size": (ct.c_size_t, (_POINTER,)),
    "frot_segment_size": (_LONG, (_POINTER,)),
    "frot_events_at_once": (_LONG, (_POINTER,)),
    "frot_state_clear": (None, (_POINTER, _POINTER)),
    "frot_set_parameter": (None, (_POINTER, _POINTER, _INT, _DOUBLE)),
    "frot_set_input": (None, (_POINTER, _POINTER, _INT, _DOUBLE)),
    "frot_get_parameter": (_DOUBLE, (_POINTER, _POINTER, _INT)),
    "frot_settle_parameters": (_INT, (_POINTER, _POINTER, _POINTER, _POINTER)),
    "frot_start": (_INT, (_POINTER, _POINTER, _POINTER, _DOUBLE, ct.POINTER(Options))),
    "frot_settle": (_INT, (_POINTER, _POINTER, _POINTER)),
    "frot_advance": (
        _INT,
        (_POINTER, _POINTER, _POINTER, _DOUBLE, ct.POINTER(Recorder), _POINTER, _POINTER),
    ),
    "frot_sample": (
        _INT,
        (_POINTER, _POINTER, _POINTER, _POINTER, _LONG, _POINTER, _LONG, _POINTER),
    ),
    "frot_values": (_INT, (_POINTER, _POINTER, _POINTER, _POINTER)),
    "frot_element_count": (_INT, (_POINTER,)),
    "frot_law_of_element": (
        _INT,
        (_POINTER, _INT, ct.POINTER(ct.c_int), ct.POINTER(ct.c_int), ct.POINTER(ct.c_int)),
    ),
    "frot_motions_size": (ct.c_size_t, (_POINTER,)),
    "frot_motions": (
        _INT,
        (_POINTER, _POINTER, _POINTER, _POINTER, _INT, ct.POINTER(MotionsFound)),
    ),
    "frot_energy": (_INT, (_POINTER, _POINTER, _POINTER, _POINTER)),
    "frot_time": (_DOUBLE, (_POINTER,)),
    "frot_last_fault": (ct.POINTER(Fault), (_POINTER,)),
    "frot_run_statistics": (ct.POINTER(Statistics), (_POINTER,)),
    "frot_fault_text": (None, (_POINTER, _POINTER, ct.c_char_p, ct.c_size_t)),
    "frot_state_name": (ct.c_char_p, (_POINTER, _INT)),
    "frot_event_text": (None, (_POINTER, ct.POINTER(RawEvent), ct.c_char_p, ct.c_size_t)),
    "frot_fault_places": (None, (_POINTER, _POINTER, ct.c_char_p, ct.c_size_t)),
}


@functools.lru_cache(maxsize=64)
def load(path: str) -> ct.CDLL:
    """A compiled model with the kernel; FrotError (E0804) if it cannot be loaded."""
    try:
        library = ct.CDLL(path)
    except OSError as error:
        raise fail(
            "E0804",
            f"the compiled model cannot be loaded: {error}",
            help=f"remove the folder '{Path(path).parent}' and run again",
        ) from None
    for name, (result, arguments) in _SIGNATURES.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library
