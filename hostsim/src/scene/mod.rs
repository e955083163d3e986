//! In: a scene's name, TOML file or OBJ file. Out: a checked [`Scene`] that answers "what does this ray hit first?".
//! Cost: linear in its spheres, logarithmic in its triangles.

mod builtin;
mod bvh;
mod camera;
mod check;
mod displaced;
mod error;
mod file;
mod frame;
mod materials;
mod mesh;
mod shapes;
mod teapot;
mod vec3;

use std::path::{Path, PathBuf};

pub use builtin::builtin_names;
pub use camera::Camera;
pub use displaced::{Displaced, MapName, Texture, Wall};
pub use error::SceneError;
pub use mesh::MAX_TRIANGLES;
pub use vec3::Vec3;

use bvh::TriangleSet;

/// The π of the reference workload; every path is traced with these fifteen digits.
#[allow(clippy::approx_constant)]
pub const PI: f64 = 3.14159265358979;

/// A ray; the direction has length one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
}

/// What a surface does with light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Scatters equally in all directions; the only kind that bears hit points.
    Diffuse {
        /// Reflectance.
        colour: Vec3,
    },
    /// A perfect mirror.
    Mirror {
        /// Reflectance.
        colour: Vec3,
    },
    /// Smooth glass in air.
    Glass {
        /// Reflectance and transmittance.
        colour: Vec3,
        /// Refractive index.
        index: f64,
    },
    /// A displaced surface from in front: only the displacement unit knows what is hit.
    Displaced {
        /// Its number in [`Scene::displaced`].
        surface: usize,
    },
}

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Radius.
    pub radius: f64,
    /// Centre.
    pub centre: Vec3,
    /// Material.
    pub material: Material,
}

/// A point that shines equally in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where.
    pub position: Vec3,
    /// Flux per steradian; the flux of the whole light, and of each photon before division by their number, is 4π of it.
    pub intensity: Vec3,
}

/// What a ray hit first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where.
    pub position: Vec3,
    /// Outward on a sphere; on a triangle as its winding says (counter-clockwise seen from outside).
    pub normal: Vec3,
    /// Whether the side the ray came from decides the recorded normal: so for triangles, whose winding models often get wrong.
    pub two_sided: bool,
    /// Material.
    pub material: Material,
}

/// What may be said beside the scene's name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// An OBJ file in place of the one the scene file names in `mesh`; an error for a scene without such a line.
    pub mesh: Option<PathBuf>,
}

/// A scene ready for tracing.
#[derive(Debug)]
pub struct Scene {
    name: String,
    notes: Vec<String>,
    spheres: Vec<Sphere>,
    triangles: Option<TriangleSet>,
    displaced: Vec<Displaced>,
    camera: Camera,
    light: Light,
    least_weight: f64,
}

impl Scene {
    /// A built-in scene by name, else a TOML or an OBJ file by path.
    ///
    /// # Errors
    /// [`SceneError`], which says what to do about it.
    pub fn load(name: &str, options: &LoadOptions) -> Result<Self, SceneError> {
        if let Some(text) = builtin::text(name) {
            return Self::from_toml(text, name, Path::new(""), options);
        }
        let path = Path::new(name);
        let builtin = || builtin_names().join(", ");
        if path.is_dir() {
            return Err(SceneError::Folder { path: path.to_owned(), builtin: builtin() });
        }
        let stem = path.file_stem().map_or_else(|| name.to_owned(), |s| s.to_string_lossy().into_owned());
        match path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).as_deref() {
            Some("toml") => {
                let text = std::fs::read_to_string(path)
                    .map_err(|e| SceneError::Unreadable { path: path.to_owned(), why: e.to_string() })?;
                Self::from_toml(&text, &stem, path.parent().unwrap_or(Path::new("")), options)
            }
            Some("obj") if options.mesh.is_some() => Err(SceneError::AlreadyMesh { path: path.to_owned() }),
            Some("obj") => match builtin::text(&stem).filter(|_| builtin::takes_mesh(&stem)) {
                // The layout of these two models is known, so their cameras are better than any guess.
                Some(text) if path.is_file() => {
                    let options = LoadOptions { mesh: Some(path.to_owned()) };
                    let mut scene = Self::from_toml(text, &stem, Path::new(""), &options)?;
                    let file = mesh::file_name(path);
                    scene
                        .notes
                        .push(format!("{file}: camera and light are those of the built-in scene `{stem}`"));
                    Ok(scene)
                }
                _ => frame::from_obj(path, &stem),
            },
            Some(extension) => Err(SceneError::Extension {
                path: path.to_owned(),
                extension: extension.to_owned(),
                builtin: builtin(),
            }),
            None => Err(SceneError::UnknownScene {
                name: name.to_owned(),
                nearest: builtin::nearest(name),
                builtin: builtin(),
            }),
        }
    }

    /// From the text of a scene file; a mesh's relative path starts at `folder`.
    ///
    /// # Errors
    /// [`SceneError`], which says what to do about it.
    pub fn from_toml(
        text: &str,
        name: &str,
        folder: &Path,
        options: &LoadOptions,
    ) -> Result<Self, SceneError> {
        file::SceneFile::parse(text, name)?.build(name, folder, options)
    }

    /// A scene of spheres alone.
    pub fn from_spheres(name: &str, spheres: Vec<Sphere>, camera: Camera, light: Light) -> Self {
        Self {
            name: name.to_owned(),
            notes: Vec::new(),
            spheres,
            triangles: None,
            displaced: Vec::new(),
            camera,
            light,
            least_weight: 0.0,
        }
    }

    /// Short name, fit for a folder.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What a user should know: materials not found, textures left out, triangles dropped, a camera guessed.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The spheres, in the order they are tried.
    pub fn spheres(&self) -> &[Sphere] {
        &self.spheres
    }

    /// How many triangles there are.
    pub fn triangle_count(&self) -> usize {
        self.triangles.as_ref().map_or(0, TriangleSet::len)
    }

    /// The displaced surfaces, in the order they are tried.
    pub fn displaced(&self) -> &[Displaced] {
        &self.displaced
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The light.
    pub fn light(&self) -> &Light {
        &self.light
    }

    /// Eye rays that carry less than this end; 0 follows all to the greatest depth.
    pub fn least_weight(&self) -> f64 {
        self.least_weight
    }

    /// The first surface a ray hits: spheres in order, then displaced surfaces, strictly nearer wins; then triangles. Of a
    /// displaced surface this is the lid.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut distance = FAR;
        let mut sphere = None;
        for s in &self.spheres {
            let d = s.distance(ray);
            if d < distance {
                distance = d;
                sphere = Some(s);
            }
        }
        let (mut limit, mut lid) = (distance, None);
        for (number, surface) in self.displaced.iter().enumerate() {
            if let Some(d) = surface.distance(ray, distance) {
                (distance, limit, lid) = (d, d - surface.near(), Some((number, surface)));
            }
        }
        if let Some(hit) = self.triangles.as_ref().and_then(|t| t.nearest(ray, limit)) {
            return Some(hit);
        }
        let position = ray.origin + ray.direction * distance;
        if let Some((number, surface)) = lid {
            let material = surface.material(number, ray.direction);
            return Some(Hit { position, normal: surface.normal(), two_sided: true, material });
        }
        let s = sphere?;
        let normal = (position - s.centre).normalised();
        Some(Hit { position, normal, two_sided: false, material: s.material })
    }
}

/// Further than anything can be: no hit.
const FAR: f64 = 1e20;
/// A ray does not hit a sphere nearer than this, so not the one it starts on.
const NEAR: f64 = 1e-4;

impl Sphere {
    /// How far along the ray; [`FAR`] when missed.
    #[inline]
    fn distance(&self, ray: &Ray) -> f64 {
        let op = self.centre - ray.origin;
        let b = op.dot(ray.direction);
        let det = b * b - op.dot(op) + self.radius * self.radius;
        if det < 0.0 {
            return FAR;
        }
        let root = det.sqrt();
        if b - root > NEAR {
            b - root
        } else if b + root > NEAR {
            b + root
        } else {
            FAR
        }
    }
}
