//! What can be wrong with a scene, and what to do about it.

use std::path::PathBuf;

/// Why a scene could not be loaded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// Neither built in nor a file this program reads.
    #[error("there is no scene `{name}`: give one of {builtin}, or the path of a .toml or .obj file")]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// What there is.
        builtin: String,
    },
    /// A file could not be read.
    #[error("cannot read {}: {why}", path.display())]
    Unreadable {
        /// Which.
        path: PathBuf,
        /// The system's words.
        why: String,
    },
    /// The scene file is not as it should be.
    #[error("scene `{scene}` is not a valid scene file:\n{why}")]
    Syntax {
        /// Which scene.
        scene: String,
        /// The parser's words, with the line.
        why: String,
    },
    /// A value makes no sense.
    #[error("scene `{scene}`, {place}: {why}")]
    Value {
        /// Which scene.
        scene: String,
        /// Which entry.
        place: String,
        /// What is wrong and what would be right.
        why: String,
    },
    /// A material is named and never defined.
    #[error(
        "scene `{scene}`, {place}: no material `{material}`; add a table [materials.{material}], or use one of: {known}"
    )]
    UnknownMaterial {
        /// Which scene.
        scene: String,
        /// Which entry.
        place: String,
        /// The name used.
        material: String,
        /// The names defined.
        known: String,
    },
    /// The scene's mesh is not there.
    #[error(
        "scene `{scene}` needs the mesh {}, which is not there: put the file there, or name one with --mesh FILE.obj \
         (or render the .obj file itself)",
        path.display()
    )]
    MissingMesh {
        /// Which scene.
        scene: String,
        /// Where it was looked for.
        path: PathBuf,
    },
    /// The mesh file is damaged.
    #[error("{} is not an OBJ file this program can read: {why}", path.display())]
    BadMesh {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
}
