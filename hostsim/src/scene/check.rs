//! In: values of a scene file. Out: the same, or an error that names scene, entry and remedy.

use super::{SceneError, Vec3};

/// Makes errors that name the scene.
pub(super) struct Check<'a> {
    pub scene: &'a str,
}

impl Check<'_> {
    pub fn value<T>(&self, place: &str, why: String) -> Result<T, SceneError> {
        Err(SceneError::Value { scene: self.scene.to_owned(), place: place.to_owned(), why })
    }

    pub fn finite(&self, place: &str, field: &str, v: [f64; 3]) -> Result<Vec3, SceneError> {
        if v.iter().any(|x| !x.is_finite()) {
            return self.value(place, format!("{field} must be three finite numbers, not {v:?}"));
        }
        Ok(v.into())
    }

    pub fn colour(&self, place: &str, field: &str, v: [f64; 3], most: f64) -> Result<Vec3, SceneError> {
        if v.iter().any(|x| !(0.0..=most).contains(x)) {
            let range = if most == 1.0 { "from 0 to 1" } else { "finite and not negative" };
            return self.value(place, format!("each number of {field} must be {range}, not {v:?}"));
        }
        Ok(v.into())
    }
}
