// Values of the encoded fields of lucerna.h, before they are shifted into place. Generated from rdl/ by `regenerate`; do not edit.

#ifndef LUCERNA_ENCODINGS_H
#define LUCERNA_ENCODINGS_H

// ident.CAPABILITIES.FORMAT: Number format
#define LUCERNA__IDENT__CAPABILITIES__FORMAT__F32 0 // 1 sign, 8 exponent, 23 fraction bits: IEEE 754 binary32, as in PREE Table I.
#define LUCERNA__IDENT__CAPABILITIES__FORMAT__F24 1 // 1 sign, 7 exponent, 16 fraction bits, in the low 24 bits of a word.
#define LUCERNA__IDENT__CAPABILITIES__FORMAT__F64 2 // A study format, which models on a host have and no hardware: numbers of registers and records are f32, those inside the datapath binary64.

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

// displace.CONFIG.SOURCE: Source
#define LUCERNA__DISPLACE__CONFIG__SOURCE__LIST 0 // RAY_COUNT ray records from RAY_BASE on.
#define LUCERNA__DISPLACE__CONFIG__SOURCE__RASTER 1 // The pixels of a camera over the plane, RASTER_SIZE of them, row by row from the top.

// displace.CONFIG.WRAP: Wrap
#define LUCERNA__DISPLACE__CONFIG__WRAP__REPEAT 0 // The map again, in both directions.
#define LUCERNA__DISPLACE__CONFIG__WRAP__BORDER 1 // Nothing: heights of 0, and a ray which ends there is a miss.

// displace.CONFIG.LEVELS_DOWN: Levels down
#define LUCERNA__DISPLACE__CONFIG__LEVELS_DOWN__ONE 1 // A level at a time, as in reference [10] of the paper.
#define LUCERNA__DISPLACE__CONFIG__LEVELS_DOWN__TWO 2 // Two levels, the best of Table 3.
#define LUCERNA__DISPLACE__CONFIG__LEVELS_DOWN__THREE 3 // Three levels.
#define LUCERNA__DISPLACE__CONFIG__LEVELS_DOWN__FOUR 4 // Four levels.

// displace.CONFIG.ASCEND: Level-up
#define LUCERNA__DISPLACE__CONFIG__ASCEND__NEVER 0 // A crossing stays on its level, as in reference [10] of the paper.
#define LUCERNA__DISPLACE__CONFIG__ASCEND__PARITY 1 // Up when the boundary crossed is the parent's too, as in reference [12] of the paper (P3).
#define LUCERNA__DISPLACE__CONFIG__ASCEND__SELECTIVE 2 // Like PARITY, unless the ray surely pierces the neighbour node: algorithm (c1) of §3.3 (P4).
#define LUCERNA__DISPLACE__CONFIG__ASCEND__COHERENT 3 // Up when the crossing before stayed on its level: algorithm (c2) of §3.3 (P5).

// displace.CONFIG.COHERENT: Coherent level-up
#define LUCERNA__DISPLACE__CONFIG__COHERENT__TOGGLE 0 // A crossing which stays sets the flag, a level-up clears it, going down leaves it.
#define LUCERNA__DISPLACE__CONFIG__COHERENT__CONSECUTIVE 1 // The same, but going down clears the flag.
#define LUCERNA__DISPLACE__CONFIG__COHERENT__PARITY 2 // As TOGGLE, but going up also needs a parent's boundary (P3).

// displace.CONFIG.RAY_FAULTS: Ray faults
#define LUCERNA__DISPLACE__CONFIG__RAY_FAULTS__RECORD 0 // Its result record says so, it is counted, and the job goes on.
#define LUCERNA__DISPLACE__CONFIG__RAY_FAULTS__STOP 1 // The job ends in error GRAZING_RAY or WATCHDOG.

// displace.CONFIG.REACH: Reach
#define LUCERNA__DISPLACE__CONFIG__REACH__ONE 1 // The neighbour node, as in the paper (P4).
#define LUCERNA__DISPLACE__CONFIG__REACH__TWO 2 // Two nodes further.
#define LUCERNA__DISPLACE__CONFIG__REACH__THREE 3 // Three nodes further.

// displace.STATUS.STATE: State
#define LUCERNA__DISPLACE__STATUS__STATE__IDLE 0 // No job; START is taken.
#define LUCERNA__DISPLACE__STATUS__STATE__RUNNING 1 // A job is being worked on.
#define LUCERNA__DISPLACE__STATUS__STATE__FAULT 2 // A job ended in the error of ERROR; START or ABORT leaves this state.

// displace.ERROR.CODE: Error code
#define LUCERNA__DISPLACE__ERROR__CODE__NONE 0 // No error since START.
#define LUCERNA__DISPLACE__ERROR__CODE__BAD_CONFIG 1 // CONFIG holds an illegal LEVELS_DOWN, ASCEND, COHERENT or REACH, or WATCHDOG is not from 1 to 65535.
#define LUCERNA__DISPLACE__ERROR__CODE__WINDOW 2 // A buffer is misaligned (maps: to 64 bytes, others: to 4) or not wholly in one window; FAULT_ADDRESS is its base.
#define LUCERNA__DISPLACE__ERROR__CODE__TOO_LARGE 3 // The byte size or the end of a buffer does not fit 32 bits; FAULT_ADDRESS is its base.
#define LUCERNA__DISPLACE__ERROR__CODE__BAD_MAP 4 // A map is larger than 4096 texels along an axis; FAULT_ADDRESS is its base.
#define LUCERNA__DISPLACE__ERROR__CODE__BAD_RASTER 5 // A raster has no pixel.
#define LUCERNA__DISPLACE__ERROR__CODE__GRAZING_RAY 6 // A listed ray does not come down on the surface (P18), or enters it 2^24 texels from the origin or further, and RAY_FAULTS is STOP; FAULT_ADDRESS is its result record.
#define LUCERNA__DISPLACE__ERROR__CODE__WATCHDOG 7 // A ray took WATCHDOG steps (P11), and RAY_FAULTS is STOP; FAULT_ADDRESS is its result record.
#define LUCERNA__DISPLACE__ERROR__CODE__OVERLAP 8 // The results would overwrite a map or the rays; FAULT_ADDRESS is RESULT_BASE.
#define LUCERNA__DISPLACE__ERROR__CODE__NOT_IDLE 9 // START while running; the running job goes on.

#endif
