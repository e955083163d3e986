//! In: triangles. Out: the nearest one a ray meets. Cost: a tree by `obvhs`, built once; logarithmic per ray.
//!
//! Only the tree comes from the library (boxes in f32, rounded outward); rays and triangles meet in f64.

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{Boundable, BvhBuildParams};

use super::{Hit, Material, Ray, Vec3};

/// A triangle, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Triangle {
    pub corners: [Vec3; 3],
    pub material: u32,
}

impl Triangle {
    /// Not normalised; twice the area long.
    pub fn area_vector(&self) -> Vec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a)
    }

    /// Too thin to have a direction.
    pub fn is_degenerate(&self) -> bool {
        let [a, b, c] = self.corners;
        let edge = (b - a).length().max((c - a).length()).max((c - b).length());
        self.area_vector().length() <= 1e-12 * edge * edge
    }
}

/// An f32 below, so that a box holds what it is the box of with room for rounding, and none is flat.
fn below(x: f64) -> f32 {
    (x as f32).next_down()
}

fn above(x: f64) -> f32 {
    (x as f32).next_up()
}

impl Boundable for Triangle {
    fn aabb(&self) -> Aabb {
        let [a, b, c] = self.corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        Aabb::new(
            [below(low.x), below(low.y), below(low.z)].into(),
            [above(high.x), above(high.y), above(high.z)].into(),
        )
    }
}

/// Corner, two edges, unit normal: what the intersection reads.
#[derive(Debug)]
struct Leaf {
    corner: Vec3,
    edge1: Vec3,
    edge2: Vec3,
    normal: Vec3,
    material: u32,
}

/// Triangles with their tree and materials.
#[derive(Debug)]
pub(super) struct TriangleSet {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
    materials: Vec<Material>,
    /// No hit nearer than this: a ray does not meet the triangle it starts on.
    near: f64,
}

#[derive(Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    count: u32,
    first: u32,
}

impl TriangleSet {
    /// Every `material` must be an index of `materials`; there must be a triangle, and none degenerate.
    pub fn new(triangles: &[Triangle], materials: Vec<Material>) -> Self {
        let mut spent = core::time::Duration::ZERO;
        let bvh: Bvh2 = build_bvh2(triangles, BvhBuildParams::medium_build(), &mut spent);
        let widen = |v: [f32; 3]| Vec3::from(v.map(f64::from));
        let nodes: Vec<Node> = bvh
            .nodes
            .iter()
            .map(|n| Node {
                low: widen(n.aabb().min.to_array()),
                high: widen(n.aabb().max.to_array()),
                count: n.prim_count,
                first: n.first_index,
            })
            .collect();
        let leaves = bvh.primitive_indices.iter().map(|&i| {
            let t = &triangles[i as usize];
            let [a, b, c] = t.corners;
            Leaf {
                corner: a,
                edge1: b - a,
                edge2: c - a,
                normal: t.area_vector().normalised(),
                material: t.material,
            }
        });
        let near = nodes.first().map_or(0.0, |root| (root.high - root.low).length() * 1e-7);
        Self { leaves: leaves.collect(), nodes, materials, near }
    }

    pub fn len(&self) -> usize {
        self.leaves.len()
    }

    /// The nearest triangle nearer than `limit`.
    pub fn nearest(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let d = ray.direction;
        let inverse = Vec3::new(steep(d.x), steep(d.y), steep(d.z));
        let mut best = limit;
        let mut found = None;
        let mut stack = Stack::default();
        if self.nodes.first()?.entry(ray, inverse, best).is_some() {
            stack.push(0);
        }
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for leaf in &self.leaves[node.first as usize..][..node.count as usize] {
                    if let Some(t) = leaf.distance(ray).filter(|&t| t > self.near && t < best) {
                        best = t;
                        found = Some(leaf);
                    }
                }
                continue;
            }
            let (left, right) = (node.first, node.first + 1);
            let enter = |child: u32| self.nodes[child as usize].entry(ray, inverse, best);
            match (enter(left), enter(right)) {
                (Some(l), Some(r)) => {
                    // The nearer child on top.
                    let (near, far) = if l <= r { (left, right) } else { (right, left) };
                    stack.push(far);
                    stack.push(near);
                }
                (Some(_), None) => stack.push(left),
                (None, Some(_)) => stack.push(right),
                (None, None) => {}
            }
        }
        let leaf = found?;
        Some(Hit {
            position: ray.origin + d * best,
            normal: leaf.normal,
            two_sided: true,
            material: self.materials[leaf.material as usize],
        })
    }
}

/// The reciprocal, but finite: zero times infinity would be no number.
fn steep(x: f64) -> f64 {
    const MOST: f64 = 1e150;
    if x.abs() * MOST > 1.0 { 1.0 / x } else { MOST.copysign(x) }
}

impl Node {
    /// Where the ray enters the box, if it does before `limit`.
    #[inline]
    fn entry(&self, ray: &Ray, inverse: Vec3, limit: f64) -> Option<f64> {
        let a = (self.low - ray.origin).scale(inverse);
        let b = (self.high - ray.origin).scale(inverse);
        let (near, far) = (a.min(b), a.max(b));
        let enter = near.x.max(near.y).max(near.z).max(0.0);
        let leave = far.x.min(far.y).min(far.z).min(limit);
        (enter <= leave).then_some(enter)
    }
}

impl Leaf {
    /// Möller and Trumbore's test, both sides.
    #[inline]
    fn distance(&self, ray: &Ray) -> Option<f64> {
        let p = ray.direction.cross(self.edge2);
        let inverse = 1.0 / self.edge1.dot(p);
        let s = ray.origin - self.corner;
        let u = s.dot(p) * inverse;
        let q = s.cross(self.edge1);
        let v = ray.direction.dot(q) * inverse;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| self.edge2.dot(q) * inverse)
    }
}

/// Nodes to visit. Deep trees are rare, so the rest of the stack is on the heap.
struct Stack {
    near: [u32; Self::NEAR],
    depth: usize,
    far: Vec<u32>,
}

impl Default for Stack {
    fn default() -> Self {
        Self { near: [0; Self::NEAR], depth: 0, far: Vec::new() }
    }
}

impl Stack {
    const NEAR: usize = 64;

    #[inline]
    fn push(&mut self, node: u32) {
        match self.near.get_mut(self.depth) {
            Some(slot) => *slot = node,
            None => self.far.push(node),
        }
        self.depth += 1;
    }

    #[inline]
    fn pop(&mut self) -> Option<u32> {
        self.depth = self.depth.checked_sub(1)?;
        match self.near.get(self.depth) {
            Some(&node) => Some(node),
            None => self.far.pop(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const GREY: Material = Material::Diffuse { colour: Vec3::splat(0.5) };

    fn vec3(range: core::ops::Range<f64>) -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(range).prop_map(Vec3::from)
    }

    proptest! {
        /// The tree finds what trying every triangle finds.
        #[test]
        fn tree_equals_linear_search(
            corners in prop::collection::vec(prop::array::uniform3(vec3(-5.0..5.0)), 1..80),
            origin in vec3(-9.0..9.0),
            aim in vec3(-1.0..1.0),
        ) {
            prop_assume!(aim.length() > 1e-3);
            let triangles: Vec<_> = corners.iter().map(|&corners| Triangle { corners, material: 0 })
                .filter(|t| !t.is_degenerate()).collect();
            prop_assume!(!triangles.is_empty());
            let set = TriangleSet::new(&triangles, vec![GREY]);
            let ray = Ray { origin, direction: aim.normalised() };
            let linear = set.leaves.iter().filter_map(|l| l.distance(&ray)).filter(|&t| t > set.near)
                .fold(f64::INFINITY, f64::min);
            match set.nearest(&ray, 1e20) {
                Some(hit) => prop_assert_eq!(hit.position, ray.origin + ray.direction * linear),
                None => prop_assert!(linear.is_infinite()),
            }
        }
    }

    #[test]
    fn an_axis_parallel_ray_meets_a_flat_wall() {
        let wall = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| Triangle {
            corners: [a.into(), b.into(), c.into()],
            material: 0,
        };
        let set = TriangleSet::new(
            &[
                wall([0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]),
                wall([1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]),
            ],
            vec![GREY],
        );
        for x in [0.0, 0.25, 0.5, 1.0] {
            let ray = Ray { origin: Vec3::new(x, 0.5, 0.0), direction: Vec3::new(0.0, 0.0, 1.0) };
            let hit = set.nearest(&ray, 1e20).expect("the wall is straight ahead");
            assert_eq!((hit.position, hit.normal), (Vec3::new(x, 0.5, 1.0), Vec3::new(0.0, 0.0, 1.0)));
        }
    }

    #[test]
    fn the_stack_keeps_order_beyond_its_array() {
        let mut stack = Stack::default();
        (0..200).for_each(|i| stack.push(i));
        assert!((0..200).rev().all(|i| stack.pop() == Some(i)));
        assert_eq!(stack.pop(), None);
    }
}
