//! In: the MTL files an OBJ file names. Out: materials, and a note on everything that does not come out as written.
//! Cost: linear in the files.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::Path;

use super::{Material, Vec3};

/// What takes the place of a material that is not there.
pub(super) const GREY: Material = Material::Diffuse { colour: Vec3::splat(0.7) };

/// A list in a note has this many names.
const LISTED: usize = 8;

/// The MTL files of one OBJ file.
#[derive(Debug, Default)]
pub(super) struct Libraries {
    /// File and reason.
    unreadable: RefCell<Vec<(String, String)>>,
    /// File, line number and text of lines left out.
    bad_lines: RefCell<Vec<(String, usize, String)>>,
    named: RefCell<Vec<String>>,
}

impl Libraries {
    /// What the library calls for each `mtllib` line. A file name may hold blanks; a line may also name several files.
    pub fn load(&self, folder: &Path, line: &Path) -> tobj::MTLLoadResult {
        let whole = line.to_string_lossy();
        let several = whole.contains(char::is_whitespace) && !folder.join(line).exists();
        let names: Vec<&str> = if several { whole.split_whitespace().collect() } else { vec![&whole] };
        let text: String = names.iter().map(|name| self.read(folder, name)).collect();
        tobj::load_mtl_buf(&mut text.as_bytes())
    }

    /// The lines that can be read: one bad number does not cost the whole file.
    fn read(&self, folder: &Path, name: &str) -> String {
        self.named.borrow_mut().push(name.to_owned());
        let bytes = match std::fs::read(folder.join(name)) {
            Ok(bytes) => bytes,
            Err(e) => {
                self.unreadable.borrow_mut().push((name.to_owned(), e.to_string()));
                return String::new();
            }
        };
        let mut good = String::new();
        for (i, line) in String::from_utf8_lossy(&bytes).lines().enumerate() {
            let alone = format!("newmtl m\n{line}\n");
            if tobj::load_mtl_buf(&mut alone.as_bytes()).is_ok() {
                good.push_str(line);
                good.push('\n');
            } else {
                self.bad_lines.borrow_mut().push((name.to_owned(), i + 1, line.trim().to_owned()));
            }
        }
        good
    }
}

/// What a user should know about the materials of a mesh.
#[derive(Debug, Default)]
pub(super) struct MaterialNotes {
    pub libraries: Libraries,
    /// Whether any material was defined.
    pub any: bool,
    /// Triangles without a known material.
    pub grey_triangles: usize,
    /// Names in `usemtl` that nothing defines.
    pub unknown: BTreeSet<String>,
    textured: BTreeSet<String>,
    thin: BTreeSet<String>,
    clamped: BTreeSet<String>,
    emitting: BTreeSet<String>,
}

fn list(names: &BTreeSet<String>) -> String {
    let mut text = names.iter().take(LISTED).map(String::as_str).collect::<Vec<_>>().join(", ");
    if names.len() > LISTED {
        text += &format!(" and {} more", names.len() - LISTED);
    }
    text
}

impl MaterialNotes {
    /// As lines for a reader.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let unreadable = self.libraries.unreadable.borrow();
        let named = self.libraries.named.borrow();
        if !unreadable.is_empty() {
            let files: Vec<_> =
                unreadable.iter().map(|(file, why)| format!("{file} cannot be read ({why})")).collect();
            let whose = if files.len() == 1 { "its" } else { "their" };
            let grey = match self.unknown.len() {
                0 => String::new(),
                1 => format!("; {whose} material is grey: {}", list(&self.unknown)),
                n => format!("; {whose} {n} materials are grey: {}", list(&self.unknown)),
            };
            lines.push(files.join(", ") + &grey);
        } else if named.is_empty() {
            lines.push("it names no MTL file: every surface is grey".to_owned());
        } else if !self.any {
            lines.push(format!("{} defines no material: every surface is grey", named.join(", ")));
        } else if !self.unknown.is_empty() {
            lines.push(format!(
                "no MTL file defines {}: {} triangles without a known material are grey",
                list(&self.unknown),
                self.grey_triangles
            ));
        } else if self.grey_triangles > 0 {
            lines.push(format!(
                "{} triangles without a known material are grey: put `usemtl` before them, after `mtllib`",
                self.grey_triangles
            ));
        }
        let bad = self.libraries.bad_lines.borrow();
        for (file, number, text) in bad.iter().take(LISTED) {
            lines.push(format!("{file} line {number} is left out, for `{text}` cannot be read"));
        }
        if bad.len() > LISTED {
            lines.push(format!("{} more MTL lines are left out", bad.len() - LISTED));
        }
        for (names, what) in [
            (&self.clamped, "reflectances that are not from 0 to 1 are clamped"),
            (&self.textured, "textures are ignored, the plain colour is used"),
            (&self.thin, "transparent without refraction, taken as opaque and diffuse"),
            (&self.emitting, "emission (Ke) is ignored, the scene's one point light shines instead"),
        ] {
            if !names.is_empty() {
                lines.push(format!("{what}: {}", list(names)));
            }
        }
        lines
    }

    /// Illumination models 3 and 5 are mirrors, 4, 6, 7 and 9 glass (when it refracts); all others diffuse.
    pub fn material(&mut self, m: &tobj::Material) -> Material {
        if m.diffuse_texture.is_some() || m.dissolve_texture.is_some() {
            self.textured.insert(m.name.clone());
        }
        if m.emissive.is_some_and(|e| e.iter().any(|&v| v > 0.0)) {
            self.emitting.insert(m.name.clone());
        }
        let index = m.optical_density.unwrap_or(1.0);
        match m.illumination_model {
            Some(3 | 5) if m.specular.is_some_and(|s| s.iter().any(|&v| v > 0.25)) => {
                return Material::Mirror { colour: self.colour(m, m.specular, 1.0) };
            }
            Some(4 | 6 | 7 | 9) if index.is_finite() && index > 1.0 => {
                return Material::Glass { colour: Vec3::ONE, index };
            }
            Some(4 | 6 | 7 | 9) => {
                self.thin.insert(m.name.clone());
            }
            _ if m.dissolve.is_some_and(|d| d < 1.0) => {
                self.thin.insert(m.name.clone());
            }
            _ => {}
        }
        Material::Diffuse { colour: self.colour(m, m.diffuse, 0.7) }
    }

    /// Reflectances above one would make light out of nothing.
    fn colour(&mut self, m: &tobj::Material, c: Option<[f64; 3]>, otherwise: f64) -> Vec3 {
        let c = c.unwrap_or([otherwise; 3]);
        if c.iter().any(|v| !(0.0..=1.0).contains(v)) {
            self.clamped.insert(m.name.clone());
        }
        Vec3::from(c.map(|v| if v.is_nan() { otherwise } else { v.clamp(0.0, 1.0) }))
    }
}
