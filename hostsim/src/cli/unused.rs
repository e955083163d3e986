//! Options of `displace` that do nothing here; in: policies and what was asked for, out: a note each; cost: none.

use lucerna_driver::displace::{Algorithm, Ascend, Coherent, LevelsDown, Policies, Wrap};

/// What was asked for beyond the algorithm.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked {
    /// `--levels-down`.
    pub levels_down: Option<u32>,
    /// `--reach`.
    pub reach: Option<u32>,
}

/// What to tell the user of `policies`, which are `algorithm`'s with the other options applied.
pub fn notes(algorithm: Algorithm, asked: Asked, policies: &Policies) -> Vec<String> {
    let name = algorithm.name();
    let mut notes = Vec::new();
    if asked.reach.is_some() && policies.ascend != Ascend::Selective {
        notes.push(format!("--reach has no effect with {name}: c1, mix and fold have a reach"));
    }
    if policies.coherent != Coherent::Toggle && policies.ascend != Ascend::Coherent {
        notes.push(format!("--coherent has no effect with {name}: c2 and mix-gpu go up by coherence"));
    }
    if policies.start_grid != 0 && !policies.start_level {
        notes.push(format!(
            "--start-grid has no effect with {name}: a, mix, mix-gpu and fold find a start level"
        ));
    }
    if let Some(levels) = asked.levels_down.filter(|levels| *levels > 1)
        && algorithm.policies().levels_down == LevelsDown::One
    {
        notes.push(format!(
            "{name} goes down one level at a time in the paper: with --levels-down {levels} it is joined with (b)"
        ));
    }
    if policies.wrap == Wrap::Border {
        notes.push(
            "--wrap border shows one copy of the map, at texture coordinates from 0 to 1; around it the height is 0"
                .to_owned(),
        );
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_nothing_is_said() {
        let asked = Asked { levels_down: Some(2), reach: Some(2) };
        let idle = Policies::OH.with_coherent(Coherent::Parity).with_start_grid(1).with_wrap(Wrap::Border);
        assert_eq!(notes(Algorithm::Oh, asked, &idle).len(), 5);
        assert_eq!(notes(Algorithm::Fold, asked, &Policies::FOLD), [""; 0]);
        let coherent = Policies::C2.with_coherent(Coherent::Parity);
        assert_eq!(notes(Algorithm::C2, Asked::default(), &coherent), [""; 0]);
    }
}
