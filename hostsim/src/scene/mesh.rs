//! In: an OBJ file and, beside it, its MTL file. Out: triangles, materials, and what was left out.
//! Cost: linear in the file.

use std::collections::BTreeSet;
use std::path::Path;

use super::bvh::Triangle;
use super::{Material, SceneError, Vec3};

/// A mesh may have this many triangles: the tree's numbers are 32-bit.
pub const MAX_TRIANGLES: usize = 1 << 28;

/// What takes the place of a material that is not there.
pub(super) const GREY: Material = Material::Diffuse { colour: Vec3::splat(0.7) };

/// What a user should know about a mesh.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MeshNotes {
    /// Triangles without an area.
    pub degenerate: usize,
    /// Triangles whose material is named nowhere.
    pub without_material: usize,
    /// Why the MTL file could not be used.
    pub no_materials: Option<String>,
    /// Materials with pictures, which are not looked at.
    pub textured: BTreeSet<String>,
    /// Transparent materials that do not refract, taken as diffuse.
    pub thin: BTreeSet<String>,
}

impl MeshNotes {
    /// As lines for a reader.
    pub fn lines(&self) -> Vec<String> {
        let list = |set: &BTreeSet<String>| set.iter().map(String::as_str).collect::<Vec<_>>().join(", ");
        let mut lines = Vec::new();
        if let Some(why) = &self.no_materials {
            lines.push(format!("{why}: every surface is grey"));
        } else if self.without_material > 0 {
            lines.push(format!("{} triangles name no known material: they are grey", self.without_material));
        }
        if self.degenerate > 0 {
            lines.push(format!("{} triangles without an area are left out", self.degenerate));
        }
        if !self.textured.is_empty() {
            lines.push(format!("textures are ignored, the plain colour is used: {}", list(&self.textured)));
        }
        if !self.thin.is_empty() {
            lines.push(format!("transparent without refraction, taken as diffuse: {}", list(&self.thin)));
        }
        lines
    }
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
    // The library does not tell a missing file from a damaged one.
    std::fs::File::open(path)
        .map_err(|e| SceneError::Unreadable { path: path.to_owned(), why: e.to_string() })?;
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let (models, loaded) = tobj::load_obj(path, &options).map_err(|e| bad(explain(e)))?;

    let mut notes = MeshNotes::default();
    let mut materials = vec![GREY];
    match loaded {
        Ok(list) if list.is_empty() => {
            notes.no_materials = Some("the OBJ file names no MTL file, or an empty one".to_owned());
        }
        Ok(list) => materials.extend(list.iter().map(|m| material(m, &mut notes))),
        Err(e) => notes.no_materials = Some(format!("the MTL file cannot be read ({e})")),
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
            notes.without_material += usize::from(!known);
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

/// Illumination models 3 and 5 are mirrors, 4, 6, 7 and 9 glass (when it refracts); all others diffuse.
fn material(m: &tobj::Material, notes: &mut MeshNotes) -> Material {
    if m.diffuse_texture.is_some() || m.dissolve_texture.is_some() {
        notes.textured.insert(m.name.clone());
    }
    // Reflectances above one would make light out of nothing.
    let colour = |c: Option<[f64; 3]>, otherwise: f64| {
        let c =
            c.unwrap_or([otherwise; 3]).map(|v| if v.is_finite() { v.clamp(0.0, 1.0) } else { otherwise });
        Vec3::from(c)
    };
    let index = m.optical_density.unwrap_or(1.0);
    match m.illumination_model {
        Some(3 | 5) if colour(m.specular, 0.0).largest() > 0.25 => {
            Material::Mirror { colour: colour(m.specular, 1.0) }
        }
        Some(4 | 6 | 7 | 9) if index.is_finite() && index > 1.0 => {
            Material::Glass { colour: Vec3::ONE, index }
        }
        Some(4 | 6 | 7 | 9) => {
            notes.thin.insert(m.name.clone());
            Material::Diffuse { colour: colour(m.diffuse, 0.7) }
        }
        _ => Material::Diffuse { colour: colour(m.diffuse, 0.7) },
    }
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
