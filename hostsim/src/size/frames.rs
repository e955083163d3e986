//! Stack frames. In: the Thumb-2 code of a function. Out: the most stack it takes for itself. Cost: a table look-up an
//! instruction.
//!
//! A frame is what `push`, `vpush`, stores that move the stack pointer down, and `sub sp` take. They are added up over the
//! whole function, since a compiler may set up the frame only on the path that needs it: with two such paths the sum is
//! more than either takes, never less.

/// The stack a function takes for itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Frame {
    /// Bytes known from the code.
    pub bytes: u32,
    /// Whether it takes a computed amount besides.
    pub computed: bool,
}

/// The frame of a function, given its halfwords without literal pools.
pub fn frame(code: &[u16]) -> Frame {
    let mut frame = Frame::default();
    let mut rest = code;
    while let [first, after @ ..] = rest {
        rest = after;
        if is_wide(*first) {
            let [second, after @ ..] = rest else { break };
            rest = after;
            frame.bytes += wide(*first, *second);
            // sub.w sp, sp, Rm
            frame.computed |= *first == 0xebad && second & 0x0f00 == 0x0d00;
        } else {
            frame.bytes += narrow(*first);
            // mov sp, Rm, and add sp, Rm
            frame.computed |= first & 0xff87 == 0x4685 || first & 0xff87 == 0x4485;
        }
    }
    frame
}

/// Whether a second halfword belongs to it (Armv7-M A5.1).
const fn is_wide(first: u16) -> bool {
    first >> 11 >= 0b11101
}

/// Bytes a 16-bit instruction takes.
fn narrow(word: u16) -> u32 {
    match word >> 7 {
        // sub sp, #imm7 * 4
        0b1_0110_0001 => u32::from(word & 0x7f) * 4,
        // push {r0-r7, lr}
        _ if word >> 9 == 0b101_1010 => (word & 0x1ff).count_ones() * 4,
        _ => 0,
    }
}

/// Bytes a 32-bit instruction takes.
fn wide(first: u16, second: u16) -> u32 {
    let low = u32::from(second & 0xff);
    match first {
        // push.w {r0-r12, lr}: stmdb sp!
        0xe92d => second.count_ones() * 4,
        // str Rt, [sp, #-imm8]!
        0xf84d if second & 0x0f00 == 0x0d00 => low,
        // strd Rt, Rt2, [sp, #-imm8 * 4]!
        0xe96d => low * 4,
        // vpush: vstmdb sp! of single (0xa) or double (0xb) registers
        0xed2d | 0xed6d if matches!(second >> 8 & 0xf, 0xa | 0xb) => low * 4,
        // sub.w sp, sp, #modified immediate
        0xf1ad | 0xf5ad if second & 0x8f00 == 0x0d00 => expand(immediate(first, second)),
        // subw sp, sp, #imm12
        0xf2ad | 0xf6ad if second & 0x8f00 == 0x0d00 => immediate(first, second),
        _ => 0,
    }
}

/// i:imm3:imm8
fn immediate(first: u16, second: u16) -> u32 {
    u32::from(first >> 10 & 1) << 11 | u32::from(second >> 12 & 7) << 8 | u32::from(second & 0xff)
}

/// ThumbExpandImm (Armv7-M A5.3.2).
fn expand(immediate: u32) -> u32 {
    let low = immediate & 0xff;
    match immediate >> 8 {
        0 => low,
        1 => low << 16 | low,
        2 => low << 24 | low << 8,
        3 => low * 0x0101_0101,
        _ => (0x80 | low & 0x7f).rotate_right(immediate >> 7),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The encodings are those of llvm-mc for `thumbv7em`.
    #[track_caller]
    fn takes(code: &[u16], bytes: u32) {
        assert_eq!(frame(code), Frame { bytes, computed: false }, "{code:x?}");
    }

    #[test]
    fn prologues() {
        takes(&[0xb5f0], 20); // push {r4-r7, lr}
        takes(&[0xb410], 4); // push {r4}
        takes(&[0xe92d, 0x4ff0], 36); // push.w {r4-r11, lr}
        takes(&[0xf84d, 0xbd04], 4); // str r11, [sp, #-4]!
        takes(&[0xe96d, 0x0104], 16); // strd r0, r1, [sp, #-16]!
        takes(&[0xed2d, 0x8b10], 64); // vpush {d8-d15}
        takes(&[0xed2d, 0x8a03], 12); // vpush {s16-s18}
        takes(&[0xb086], 24); // sub sp, #24
        takes(&[0xb0ff], 508); // sub sp, #508
        takes(&[0xf5ad, 0x7d00], 512); // sub.w sp, sp, #512
        takes(&[0xf5ad, 0x5d80], 4096); // sub.w sp, sp, #4096
        takes(&[0xf2ad, 0x6d0c], 1548); // subw sp, sp, #1548
        takes(&[0xf6ad, 0x7dfc], 4092); // subw sp, sp, #4092
        takes(&[0xe92d, 0x4ff0, 0xed2d, 0x8b02, 0xf5ad, 0x5dc0, 0xb081], 36 + 8 + 6144 + 4);
    }

    #[test]
    fn what_takes_no_stack() {
        takes(&[0xbdf0], 0); // pop {r4-r7, pc}
        takes(&[0xe8bd, 0x8ff0], 0); // pop.w {r4-r11, pc}
        takes(&[0xb006], 0); // add sp, #24
        takes(&[0x466f], 0); // mov r7, sp
        takes(&[0xf8cd, 0xd004], 0); // str.w sp, [sp, #4]
        takes(&[0xf84d, 0x0c04], 0); // str r0, [sp, #-4]: no write-back
        takes(&[0xf1a0, 0x0d08], 0); // sub.w sp, r0, #8 has another base
        takes(&[0xecbd, 0x8b10], 0); // vpop {d8-d15}
        takes(&[0xf000, 0xb5f0], 0); // the second half of a branch is no push
        takes(&[0x4770], 0); // bx lr
    }

    #[test]
    fn a_computed_frame_is_said_to_be_one() {
        assert!(frame(&[0xb580, 0xebad, 0x0d00]).computed); // sub.w sp, sp, r0
        assert!(frame(&[0x4685]).computed); // mov sp, r0
        assert!(frame(&[0x44a5]).computed); // add sp, r4
    }

    #[test]
    fn modified_immediates() {
        assert_eq!(expand(0x0ab), 0xab);
        assert_eq!(expand(0x1ab), 0x00ab_00ab);
        assert_eq!(expand(0x2ab), 0xab00_ab00);
        assert_eq!(expand(0x3ab), 0xabab_abab);
        assert_eq!(expand(0x42b), 0xab << 24, "rotated right by 8, the top bit implied");
        assert_eq!(expand(0x4ab), 0xab << 23, "by 9");
        assert_eq!(expand(0xfff), 0xff << 1);
    }
}
