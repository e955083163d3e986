//! The scenes that come with the project, from `fixtures/scenes`.

const SCENES: [(&str, &str); 4] = [
    ("cornell-balls", include_str!("../../../fixtures/scenes/cornell-balls.toml")),
    ("cornell-teapot", include_str!("../../../fixtures/scenes/cornell-teapot.toml")),
    ("sibenik", include_str!("../../../fixtures/scenes/sibenik.toml")),
    ("conference", include_str!("../../../fixtures/scenes/conference.toml")),
];

/// The names [`super::Scene::load`] knows. The last two need a mesh that does not come with the project.
pub fn builtin_names() -> [&'static str; SCENES.len()] {
    SCENES.map(|(name, _)| name)
}

pub(super) fn text(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// Whether the scene is a camera and a light for a mesh of the user's.
pub(super) fn takes_mesh(name: &str) -> bool {
    matches!(name, "sibenik" | "conference")
}
