//! In: an OBJ file and, beside it, its MTL files. Out: triangles, materials, and what was left out.
//! Cost: linear in the file.

use std::collections::BTreeSet;
use std::path::Path;

use super::bvh::Triangle;
use super::materials::{GREY, MaterialNotes};
use super::{Material, SceneError, Vec3};

/// A mesh may have this many triangles: the tree's numbers are 32-bit.
pub const MAX_TRIANGLES: usize = 1 << 28;

/// What a user should know about a mesh.
#[derive(Debug, Default)]
pub(super) struct MeshNotes {
    /// Triangles without an area.
    degenerate: usize,
    materials: MaterialNotes,
}

impl MeshNotes {
    /// As lines for a reader, each beginning with the file's name.
    pub fn lines(&self, file: &str) -> Vec<String> {
        let mut lines = self.materials.lines();
        if self.degenerate > 0 {
            lines.push(format!("{} triangles without an area are left out", self.degenerate));
        }
        lines.iter().map(|line| format!("{file}: {line}")).collect()
    }
}

/// How notes call a file.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

pub(super) struct Mesh {
    pub triangles: Vec<Triangle>,
    /// Number 0 is the grey for whatever has none.
    pub materials: Vec<Material>,
    pub notes: MeshNotes,
}

/// Reads an OBJ file. Polygons become fans; negative indices and missing normals are as the format allows.
pub(super) fn load(path: &Path) -> Result<Mesh, SceneError> {
    let bad = |why: String| SceneError::BadMesh { path: path.to_owned(), why };
    let bytes = std::fs::read(path)
        .map_err(|e| SceneError::Unreadable { path: path.to_owned(), why: e.to_string() })?;
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let mut notes = MeshNotes::default();
    let folder = path.parent().unwrap_or(Path::new(""));
    let (models, loaded) = tobj::load_obj_buf(&mut bytes.as_slice(), &options, |line| {
        notes.materials.libraries.load(folder, line)
    })
    .map_err(|e| bad(explain(e)))?;

    // The MTL loader never fails: what it cannot read is in its notes.
    let loaded = loaded.unwrap_or_default();
    notes.materials.any = !loaded.is_empty();
    notes.materials.unknown = used_names(&bytes);
    let mut materials = vec![GREY];
    for m in &loaded {
        notes.materials.unknown.remove(&m.name);
        materials.push(notes.materials.material(m));
    }

    let mut triangles = Vec::new();
    for model in &models {
        let mesh = &model.mesh;
        let corner = |i: u32| {
            let at = 3 * i as usize;
            Vec3::new(mesh.positions[at], mesh.positions[at + 1], mesh.positions[at + 2])
        };
        let number = mesh.material_id.map_or(0, |i| i + 1);
        let known = number > 0 && number < materials.len();
        for face in mesh.indices.chunks_exact(3) {
            let corners = [corner(face[0]), corner(face[1]), corner(face[2])];
            if let Some(p) = corners.iter().find(|p| !p.is_finite() || p.largest_magnitude() > 1e18) {
                return Err(bad(format!(
                    "a vertex of `{}` is at ({}, {}, {}): coordinates must be finite and below 1e18",
                    model.name, p.x, p.y, p.z
                )));
            }
            let triangle = Triangle { corners, material: if known { number as u32 } else { 0 } };
            if triangle.is_degenerate() {
                notes.degenerate += 1;
                continue;
            }
            notes.materials.grey_triangles += usize::from(!known);
            triangles.push(triangle);
        }
    }
    if triangles.is_empty() {
        return Err(bad(format!("it has no faces with an area ({} without)", notes.degenerate)));
    }
    if triangles.len() > MAX_TRIANGLES {
        return Err(bad(format!("it has {} triangles, more than {MAX_TRIANGLES}", triangles.len())));
    }
    Ok(Mesh { triangles, materials, notes })
}

impl Vec3 {
    fn largest_magnitude(self) -> f64 {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }
}

/// The names in `usemtl` lines: the library does not tell which of them it did not find.
fn used_names(obj: &[u8]) -> BTreeSet<String> {
    let lines = obj.split(|&b| b == b'\n').map(<[u8]>::trim_ascii);
    let names = lines.filter_map(|line| line.strip_prefix(b"usemtl")).map(<[u8]>::trim_ascii);
    names.map(|name| String::from_utf8_lossy(name).into_owned()).collect()
}

fn explain(e: tobj::LoadError) -> String {
    use tobj::LoadError as E;
    match e {
        E::FaceVertexOutOfBounds | E::FaceTexCoordOutOfBounds | E::FaceNormalOutOfBounds => {
            format!("{e}: a face uses a number no line before it defines; export the mesh again")
        }
        E::PositionParseError | E::NormalParseError | E::TexcoordParseError | E::ColorParseError => {
            format!("{e}: a `v`, `vn` or `vt` line holds something that is not a number")
        }
        E::FaceParseError | E::InvalidPolygon => format!("{e}: an `f` line is malformed"),
        E::UnrecognizedCharacter | E::ReadError => format!("{e}: is it a text file?"),
        other => other.to_string(),
    }
}
