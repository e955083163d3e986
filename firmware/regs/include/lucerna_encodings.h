// Values of the encoded fields of lucerna.h, before they are shifted into place. Generated from rdl/ by `regenerate`; do not edit.

#ifndef LUCERNA_ENCODINGS_H
#define LUCERNA_ENCODINGS_H

// ident.CAPABILITIES.FORMAT: Number format
#define LUCERNA__IDENT__CAPABILITIES__FORMAT__F32 0 // 1 sign, 8 exponent, 23 fraction bits: IEEE 754 binary32, as in PREE Table I.
#define LUCERNA__IDENT__CAPABILITIES__FORMAT__F24 1 // 1 sign, 7 exponent, 16 fraction bits, in the low 24 bits of a word.

// pree.CONFIG.MODE: Mode
#define LUCERNA__PREE__CONFIG__MODE__UPDATE 0 // Hit-point update operations, photons taken from the ring (AFTSO-HpUOC, PREE §IV.B).
#define LUCERNA__PREE__CONFIG__MODE__EVALUATE 1 // Radiance evaluation of all hit points into pixels (ADISO-REC, PREE §IV.C).

// pree.CONFIG.HAZARD: Hazard policy
#define LUCERNA__PREE__CONFIG__HAZARD__INTERLOCK 0 // An operation waits until the one before it has been written back: every bit as if in order.
#define LUCERNA__PREE__CONFIG__HAZARD__FORWARD 1 // An operation waits until the result in flight can be bypassed into the stage that needs it (6 cycles in an update, 2 in an evaluation): every bit as if in order.
#define LUCERNA__PREE__CONFIG__HAZARD__PUBLISHED 2 // No protection, as the paper has none: stale reads happen and are counted.

// pree.CONFIG.BUSY: Busy style
#define LUCERNA__PREE__CONFIG__BUSY__REGISTERED 0 // A photon is accepted if the buffer was not full at the start of the cycle.
#define LUCERNA__PREE__CONFIG__BUSY__COMBINATIONAL 1 // A photon is accepted into whatever room the shift of this cycle left.

// pree.CONFIG.INPUT_WIDTH: Input width
#define LUCERNA__PREE__CONFIG__INPUT_WIDTH__ONE 1 // One photon a cycle, as in Fig. 8.
#define LUCERNA__PREE__CONFIG__INPUT_WIDTH__TWO 2 // Two photons a cycle.
#define LUCERNA__PREE__CONFIG__INPUT_WIDTH__FOUR 4 // Four photons a cycle: the whole buffer.

// pree.CONFIG.SCHEDULER: Scheduler of updates
#define LUCERNA__PREE__CONFIG__SCHEDULER__AFTSO 0 // Up to four photons share a dispatch (PREE §IV.B).
#define LUCERNA__PREE__CONFIG__SCHEDULER__ONE_PHOTON 1 // One photon a dispatch: the baseline of Table II without AFTSO.

// pree.CONFIG.ALLOCATION: Allocation of evaluations
#define LUCERNA__PREE__CONFIG__ALLOCATION__LEAPING 0 // Leaping addresses, which keep hit points of a pixel apart (PREE §IV.C).
#define LUCERNA__PREE__CONFIG__ALLOCATION__SEQUENTIAL 1 // Each unit walks its group address by address (Fig. 3): the baseline of Fig. 4.

// pree.STATUS.STATE: State
#define LUCERNA__PREE__STATUS__STATE__IDLE 0 // No job; START is taken.
#define LUCERNA__PREE__STATUS__STATE__RUNNING 1 // A job is being worked on.
#define LUCERNA__PREE__STATUS__STATE__FAULT 2 // A job ended in the error of ERROR; START or ABORT leaves this state.

// pree.ERROR.CODE: Error code
#define LUCERNA__PREE__ERROR__CODE__NONE 0 // No error since START.
#define LUCERNA__PREE__ERROR__CODE__BAD_CONFIG 1 // CONFIG holds an illegal hazard policy or input width.
#define LUCERNA__PREE__ERROR__CODE__BAD_RING 2 // RING_ENTRIES is not a power of two from 1 to 65536.
#define LUCERNA__PREE__ERROR__CODE__WINDOW 3 // A buffer is misaligned or not wholly in one window; FAULT_ADDRESS is its base.
#define LUCERNA__PREE__ERROR__CODE__RING_OVERRUN 4 // RING_TAIL ran more than RING_ENTRIES ahead of RING_HEAD, or moved on after FLUSH; FAULT_ADDRESS is the base of the ring.
#define LUCERNA__PREE__ERROR__CODE__INDEX_RANGE 5 // The list of a photon leaves the index table; FAULT_ADDRESS is the record.
#define LUCERNA__PREE__ERROR__CODE__HIT_RANGE 6 // An index entry is not below HIT_COUNT; FAULT_ADDRESS is the entry.
#define LUCERNA__PREE__ERROR__CODE__PIXEL_RANGE 7 // The pixel of a hit point is not below PIXEL_COUNT; FAULT_ADDRESS is the hit point.
#define LUCERNA__PREE__ERROR__CODE__NOT_IDLE 8 // START while running; the running job goes on.
#define LUCERNA__PREE__ERROR__CODE__TOO_LARGE 9 // The byte size or the end of a buffer does not fit 32 bits; FAULT_ADDRESS is its base.

#endif
