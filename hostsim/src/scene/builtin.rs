//! The scenes that come with the project, from `fixtures/scenes`.

const SCENES: [(&str, &str); 6] = [
    ("cornell-balls", include_str!("../../../fixtures/scenes/cornell-balls.toml")),
    ("cornell-teapot", include_str!("../../../fixtures/scenes/cornell-teapot.toml")),
    ("relief-room", include_str!("../../../fixtures/scenes/relief-room.toml")),
    ("sibenik", include_str!("../../../fixtures/scenes/sibenik.toml")),
    ("conference", include_str!("../../../fixtures/scenes/conference.toml")),
    ("kitchen", include_str!("../../../fixtures/scenes/kitchen.toml")),
];

/// The names [`super::Scene::load`] knows. The last three need a mesh that does not come with the project.
pub fn builtin_names() -> [&'static str; SCENES.len()] {
    SCENES.map(|(name, _)| name)
}

pub(super) fn text(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// Whether the scene is a camera and a light for a mesh of the user's.
pub(super) fn takes_mesh(name: &str) -> bool {
    matches!(name, "sibenik" | "conference" | "kitchen")
}

/// The built-in name a misspelt one probably means: its beginning, or at most a third of the letters away.
pub(super) fn nearest(name: &str) -> Option<&'static str> {
    let asked = name.to_lowercase();
    let begins = |n: &&str| asked.len() >= 3 && n.starts_with(&asked);
    let close = || {
        let ranked = builtin_names().into_iter().map(|n| (distance(&asked, n), n));
        ranked.min().filter(|(d, n)| 3 * d <= n.len()).map(|(_, n)| n)
    };
    builtin_names().into_iter().find(begins).or_else(close)
}

/// Levenshtein's: how many letters must be put in, left out or changed.
fn distance(a: &str, b: &str) -> usize {
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.chars().enumerate() {
            let changed = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.chars().count()]
}
