//! In: the text of a scene file (TOML). Out: a checked [`Scene`], or an error that names the entry and the remedy.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::bvh::{Triangle, TriangleSet};
use super::check::Check;
use super::displaced::DisplacedEntry;
use super::shapes::{Placement, unit_box};
use super::{Camera, Light, LoadOptions, Material, Scene, SceneError, Sphere, mesh, teapot};

/// A scene file as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneFile {
    #[serde(default, rename = "description")]
    _description: String,
    mesh: Option<PathBuf>,
    camera: CameraEntry,
    light: LightEntry,
    #[serde(default)]
    tracing: TracingEntry,
    #[serde(default)]
    materials: BTreeMap<String, MaterialEntry>,
    #[serde(default)]
    spheres: Vec<SphereEntry>,
    #[serde(default)]
    objects: Vec<ObjectEntry>,
    #[serde(default)]
    displaced: Vec<DisplacedEntry>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraEntry {
    eye: [f64; 3],
    target: Option<[f64; 3]>,
    direction: Option<[f64; 3]>,
    #[serde(default = "upright")]
    up: [f64; 3],
    right: Option<[f64; 3]>,
    field_of_view: Option<f64>,
    height: Option<f64>,
    #[serde(default)]
    start: f64,
}

fn upright() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LightEntry {
    position: [f64; 3],
    intensity: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct TracingEntry {
    least_weight: f64,
}

impl Default for TracingEntry {
    fn default() -> Self {
        Self { least_weight: super::frame::LEAST_WEIGHT }
    }
}

#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
enum MaterialEntry {
    Diffuse { colour: [f64; 3] },
    Mirror { colour: [f64; 3] },
    Glass { colour: [f64; 3], index: f64 },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereEntry {
    radius: f64,
    centre: [f64; 3],
    material: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectEntry {
    shape: Shape,
    material: String,
    #[serde(default)]
    position: [f64; 3],
    #[serde(default = "unit")]
    size: [f64; 3],
    #[serde(default)]
    turn: f64,
    #[serde(default = "fine")]
    detail: u32,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Shape {
    Box,
    Teapot,
}

fn unit() -> [f64; 3] {
    [1.0; 3]
}

fn fine() -> u32 {
    12
}

impl SceneFile {
    pub fn parse(text: &str, scene: &str) -> Result<Self, SceneError> {
        if text.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#')) {
            return Err(SceneError::Empty { scene: scene.to_owned() });
        }
        toml::from_str(text).map_err(|e| SceneError::Syntax {
            scene: scene.to_owned(),
            why: e.to_string().trim_end().to_owned(),
        })
    }

    pub fn build(self, scene: &str, folder: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
        if let (Some(mesh), None) = (&options.mesh, &self.mesh) {
            return Err(SceneError::NoPlaceForMesh { scene: scene.to_owned(), mesh: mesh.clone() });
        }
        let check = Check { scene };
        let camera = self.camera.build(&check)?;
        let light = Light {
            position: check.finite("[light]", "position", self.light.position)?,
            intensity: check.colour("[light]", "intensity", self.light.intensity, f64::MAX)?,
        };
        let least_weight = self.tracing.least_weight;
        if !(0.0..1.0).contains(&least_weight) {
            return check
                .value("[tracing]", format!("least_weight must be from 0 to below 1, not {least_weight}"));
        }

        let mut materials = BTreeMap::new();
        for (name, entry) in &self.materials {
            materials.insert(name.as_str(), entry.build(&check, &format!("[materials.{name}]"))?);
        }
        let find = |place: &str, material: &str| {
            materials.get(material).copied().ok_or_else(|| SceneError::UnknownMaterial {
                scene: scene.to_owned(),
                place: place.to_owned(),
                material: material.to_owned(),
                known: materials.keys().copied().collect::<Vec<_>>().join(", "),
            })
        };

        let mut spheres = Vec::new();
        for (i, entry) in self.spheres.iter().enumerate() {
            let place = format!("[[spheres]] number {}", i + 1);
            if !(entry.radius.is_finite() && entry.radius > 0.0) {
                return check.value(&place, format!("the radius must be above zero, not {}", entry.radius));
            }
            spheres.push(Sphere {
                radius: entry.radius,
                centre: check.finite(&place, "centre", entry.centre)?,
                material: find(&place, &entry.material)?,
            });
        }

        let mut notes = Vec::new();
        let (mut triangles, mut palette) = (Vec::new(), Vec::new());
        if let Some(path) = options.mesh.clone().or_else(|| self.mesh.map(|m| folder.join(m))) {
            if !path.is_file() {
                return Err(SceneError::MissingMesh { scene: scene.to_owned(), path });
            }
            let loaded = mesh::load(&path)?;
            triangles = loaded.triangles;
            palette = loaded.materials;
            notes.extend(loaded.notes.lines(&mesh::file_name(&path)));
        }
        for (i, entry) in self.objects.iter().enumerate() {
            let place = format!("[[objects]] number {}", i + 1);
            let material = find(&place, &entry.material)?;
            triangles.extend(entry.triangles(&check, &place, palette.len() as u32)?);
            palette.push(material);
        }
        let displaced = self.displaced.iter().enumerate();
        let displaced: Vec<_> =
            displaced.map(|(i, entry)| entry.build(&check, i, folder)).collect::<Result<_, _>>()?;
        if spheres.is_empty() && triangles.is_empty() && displaced.is_empty() {
            let why = "it holds nothing: add [[spheres]], [[objects]], [[displaced]] or a `mesh`";
            return check.value("the file", why.to_owned());
        }

        let triangles = (!triangles.is_empty()).then(|| TriangleSet::new(&triangles, palette));
        Ok(Scene {
            name: scene.to_owned(),
            notes,
            spheres,
            triangles,
            displaced,
            camera,
            light,
            least_weight,
        })
    }
}

impl CameraEntry {
    fn build(&self, check: &Check<'_>) -> Result<Camera, SceneError> {
        let place = "[camera]";
        let eye = check.finite(place, "eye", self.eye)?;
        let direction = match (self.target, self.direction) {
            (Some(target), None) => check.finite(place, "target", target)? - eye,
            (None, Some(direction)) => check.finite(place, "direction", direction)?,
            _ => return check.value(place, "give either a `target` or a `direction`".to_owned()),
        };
        let direction = direction.normalised();
        let up = check.finite(place, "up", self.up)?;
        let right = match self.right {
            Some(right) => check.finite(place, "right", right)?,
            None => direction.cross(up),
        }
        .normalised();
        if !direction.is_finite() || !right.is_finite() || !right.cross(direction).normalised().is_finite() {
            let why = "it looks nowhere: `target` must differ from `eye`, and `up` must not be the viewing direction";
            return check.value(place, why.to_owned());
        }
        let height = match (self.field_of_view, self.height) {
            (Some(degrees), None) if degrees > 0.0 && degrees < 180.0 => {
                2.0 * (degrees.to_radians() / 2.0).tan()
            }
            (None, Some(height)) if height.is_finite() && height > 0.0 => height,
            (Some(_), None) => {
                return check.value(place, "field_of_view is in degrees, above 0 and below 180".to_owned());
            }
            (None, Some(_)) => return check.value(place, "height must be above zero".to_owned()),
            _ => return check.value(place, "give either a `field_of_view` or a `height`".to_owned()),
        };
        if !(self.start.is_finite() && self.start >= 0.0) {
            return check.value(place, format!("start must not be negative, but is {}", self.start));
        }
        Ok(Camera { eye, direction, right, height, start: self.start })
    }
}

impl MaterialEntry {
    fn build(&self, check: &Check<'_>, place: &str) -> Result<Material, SceneError> {
        let colour = |c: &[f64; 3]| check.colour(place, "colour", *c, 1.0);
        Ok(match self {
            Self::Diffuse { colour: c } => Material::Diffuse { colour: colour(c)? },
            Self::Mirror { colour: c } => Material::Mirror { colour: colour(c)? },
            Self::Glass { colour: c, index } => {
                if !(index.is_finite() && *index > 0.0) {
                    return check.value(place, format!("the index must be above zero, not {index}"));
                }
                Material::Glass { colour: colour(c)?, index: *index }
            }
        })
    }
}

impl ObjectEntry {
    fn triangles(&self, check: &Check<'_>, place: &str, material: u32) -> Result<Vec<Triangle>, SceneError> {
        let placement = Placement {
            size: check.finite(place, "size", self.size)?,
            turn: self.turn,
            position: check.finite(place, "position", self.position)?,
        };
        if self.size.iter().any(|&s| s <= 0.0) || !self.turn.is_finite() {
            return check
                .value(place, "every size must be above zero, and turn a number of degrees".to_owned());
        }
        if !(1..=256).contains(&self.detail) {
            return check.value(place, format!("detail must be from 1 to 256, not {}", self.detail));
        }
        let shape = match self.shape {
            Shape::Box => unit_box(),
            Shape::Teapot => teapot::teapot(self.detail),
        };
        let placed =
            shape.into_iter().map(|corners| Triangle { corners: placement.apply(corners), material });
        Ok(placed.filter(|t| !t.is_degenerate()).collect())
    }
}
