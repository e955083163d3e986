//! What can be wrong with a scene, and what to do about it.

use std::path::PathBuf;

/// Why a scene could not be loaded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// Neither built in nor a file this program reads.
    #[error("there is no scene `{name}`{}: give one of {builtin}, or the path of a .toml or .obj file",
        nearest.map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default())]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// The built-in name most like it.
        nearest: Option<&'static str>,
        /// What there is.
        builtin: String,
    },
    /// A folder where a file should be.
    #[error("{} is a folder, not a scene: give the path of a .toml or .obj file in it, or one of {builtin}", path.display())]
    Folder {
        /// Which.
        path: PathBuf,
        /// What there is.
        builtin: String,
    },
    /// A kind of file this program does not read.
    #[error(
        "{}: a scene is a .toml or an .obj file, and .{extension} files cannot be read; export the model as Wavefront OBJ, \
         or give one of {builtin}",
        path.display()
    )]
    Extension {
        /// Which file.
        path: PathBuf,
        /// How its name ends.
        extension: String,
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
    #[error("scene `{scene}` is not a valid scene file (docs/scenes.md describes the format):\n{why}")]
    Syntax {
        /// Which scene.
        scene: String,
        /// The parser's words, with the line.
        why: String,
    },
    /// A scene file without an entry.
    #[error(
        "scene `{scene}` is an empty file: it needs at least [camera], [light] and something to look at; \
         fixtures/scenes/cornell-balls.toml is an example, docs/scenes.md describes the format"
    )]
    Empty {
        /// Which scene.
        scene: String,
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
        "scene `{scene}` needs the mesh {}, which is not there or is no file: put the file there, or name one with --mesh FILE.obj \
         (or render the .obj file itself)",
        path.display()
    )]
    MissingMesh {
        /// Which scene.
        scene: String,
        /// Where it was looked for.
        path: PathBuf,
    },
    /// A mesh was given for a scene which is one.
    #[error("{}: the scene is already a mesh: leave --mesh away, or render that file itself", path.display())]
    AlreadyMesh {
        /// The scene.
        path: PathBuf,
    },
    /// A mesh was given for a scene which has no place for one.
    #[error(
        "scene `{scene}` names no mesh, so {} has no place in it: leave --mesh away, render the .obj file itself, \
         or add a line mesh = \"FILE.obj\" to a scene file of your own",
        mesh.display()
    )]
    NoPlaceForMesh {
        /// Which scene.
        scene: String,
        /// The mesh given.
        mesh: PathBuf,
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
