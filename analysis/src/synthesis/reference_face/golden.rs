//! The reference face against numbers computed by an independent implementation, and its own promises.

use std::collections::HashMap;

use nalgebra::{DMatrix, Vector3};

use super::actor_parts;
use crate::{
    face::{
        actor::{ActorParts, MarkerPlace},
        marker::VirtualMarker,
        region::FaceRegion,
    },
    synthesis::pseudo_muscle::mirror,
};

/// The fixtures carry nine decimals; the face is promised to a millionth of a centimeter.
const TOLERANCE_CM: f64 = 1e-6;

const NEUTRAL: &str = include_str!("../../../fixtures/reference_face_neutral.csv");
const TRIANGLES: &str = include_str!("../../../fixtures/reference_face_triangles.csv");
const BASIS: &str = include_str!("../../../fixtures/reference_face_basis.csv");
const MARKERS: &str = include_str!("../../../fixtures/reference_face_markers.csv");

fn rows(csv: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    csv.lines().skip(1).map(|line| line.split(',').collect())
}

fn number(field: &str) -> f64 {
    field.parse().unwrap()
}

fn vector(fields: &[&str]) -> Vector3<f64> {
    Vector3::new(number(fields[0]), number(fields[1]), number(fields[2]))
}

/// Full names of the fixtures' short ones: sides are `_L`, `_R`, the top is `_T`.
fn full_name(short: &str) -> String {
    let short = short
        .replace("levator_labii", "levator_labii_superioris")
        .replace("zygomatic", "zygomatic_major")
        .replace("brow_in_", "brow_inner_")
        .replace("brow_mid_", "brow_middle_")
        .replace("brow_out_", "brow_outer_")
        .replace("uplip_", "upper_lip_")
        .replace("lolip_", "lower_lip_")
        .replace("corner_", "mouth_corner_");
    for (suffix, full) in [
        ("_L", "_left"),
        ("_R", "_right"),
        ("_T", "_top"),
        ("_mid", "_middle"),
    ] {
        if let Some(stem) = short.strip_suffix(suffix) {
            return format!("{stem}{full}");
        }
    }
    short
}

fn place(parts: &ActorParts, marker_idx: usize) -> VirtualMarker {
    match parts.markers[marker_idx].1 {
        MarkerPlace::OnTriangle(place) => place,
        _ => panic!("marker {marker_idx} is not bound to a triangle"),
    }
}

fn assert_near(found: Vector3<f64>, expected: Vector3<f64>, what: &str) {
    let off = (found - expected).amax();
    assert!(off < TOLERANCE_CM, "{what}: {found} instead of {expected}");
}

#[test]
fn the_neutral_face_is_the_independent_one() {
    let vertices = actor_parts().mesh.vertices;
    assert_eq!(vertices.len(), 1_536);
    assert_eq!(rows(NEUTRAL).count(), 1_536);
    for (at, (vertex, row)) in vertices.iter().zip(rows(NEUTRAL)).enumerate() {
        assert_near(vertex.0.coords, vector(&row), &format!("vertex {at}"));
    }
}

#[test]
fn the_triangles_are_the_independent_ones() {
    let expected: Vec<[u32; 3]> = rows(TRIANGLES)
        .map(|row| [0, 1, 2].map(|at| row[at].parse().unwrap()))
        .collect();
    assert_eq!(expected.len(), 2_860);
    assert_eq!(actor_parts().mesh.triangles, expected);
}

#[test]
fn every_muscle_moves_every_vertex_as_the_independent_one_does() {
    let parts = actor_parts();
    let moved: HashMap<(String, usize), Vector3<f64>> = rows(BASIS)
        .map(|row| {
            (
                (full_name(row[0]), row[1].parse().unwrap()),
                vector(&row[2..]),
            )
        })
        .collect();
    // The fixture leaves out what moves less than a ten-thousandth of a centimeter.
    let left_out = 1e-4;
    let mut compared = 0;
    for (muscle, element) in parts.muscles.iter().zip(&parts.basis.displacements_cm) {
        for (vertex, displacement) in element.iter().enumerate() {
            match moved.get(&(muscle.name.clone(), vertex)) {
                Some(expected) => {
                    assert_near(
                        *displacement,
                        *expected,
                        &format!("{} at {vertex}", muscle.name),
                    );
                    compared += 1;
                }
                None => assert!(
                    displacement.norm() < left_out + TOLERANCE_CM,
                    "{}",
                    muscle.name
                ),
            }
        }
    }
    assert_eq!(compared, moved.len());
}

#[test]
fn every_marker_sits_where_the_independent_one_does() {
    let parts = actor_parts();
    assert_eq!(parts.markers.len(), rows(MARKERS).count());
    for (at, row) in rows(MARKERS).enumerate() {
        let marker = &parts.markers[at].0;
        let bound = place(&parts, at);
        assert_eq!(marker.name, full_name(row[0]));
        assert_eq!(marker.head_fixed, row[1] == "H", "{}", marker.name);
        assert_eq!(
            marker.region == FaceRegion::Lower,
            row[1] == "L",
            "{}",
            marker.name
        );
        assert_near(
            bound.position(&parts.mesh).0.coords,
            vector(&row[2..5]),
            &marker.name,
        );
        let vertices = [5, 6, 7].map(|field| row[field].parse::<u32>().unwrap());
        assert_eq!(
            parts.mesh.triangles[bound.triangle], vertices,
            "{}",
            marker.name
        );
        assert_near(
            Vector3::from(bound.barycentric),
            vector(&row[8..]),
            &marker.name,
        );
    }
}

#[test]
fn muscles_are_named_in_full_and_the_upper_six_come_first() {
    let muscles = actor_parts().muscles;
    let names: Vec<&str> = muscles.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "frontalis_left",
            "frontalis_right",
            "corrugator_left",
            "corrugator_right",
            "orbicularis_oculi_left",
            "orbicularis_oculi_right",
            "levator_labii_superioris_left",
            "levator_labii_superioris_right",
            "zygomatic_major_left",
            "zygomatic_major_right",
            "risorius_left",
            "risorius_right",
            "depressor_anguli_oris",
            "orbicularis_oris",
            "lips_pressor",
            "jaw_rotation",
        ]
    );
    for (at, muscle) in muscles.iter().enumerate() {
        assert_eq!(
            muscle.region == FaceRegion::Upper,
            at < 6,
            "{}",
            muscle.name
        );
    }
}

/// A place as a key that compares exactly; adding zero makes −0 the same as 0.
fn key(place: Vector3<f64>) -> [u64; 3] {
    [place.x, place.y, place.z].map(|coordinate| (coordinate + 0.0).to_bits())
}

/// For every vertex, the one at exactly the mirrored place.
fn mirror_images() -> Vec<usize> {
    let vertices = actor_parts().mesh.vertices;
    let places = vertices.iter().map(|vertex| vertex.0.coords);
    let at: HashMap<[u64; 3], usize> = places.clone().map(key).zip(0..).collect();
    assert_eq!(at.len(), vertices.len(), "no two vertices share a place");
    places.map(|place| at[&key(mirror(place))]).collect()
}

/// The name of the same muscle or marker on the other side.
fn other_side(name: &str) -> String {
    match name.strip_suffix("_left") {
        Some(stem) => format!("{stem}_right"),
        None => name.replace("_right", "_left"),
    }
}

#[test]
fn the_face_is_its_own_mirror_image_to_the_last_bit() {
    let images = mirror_images();
    assert!(
        images
            .iter()
            .enumerate()
            .all(|(at, image)| images[*image] == at)
    );
}

#[test]
fn left_and_right_muscles_mirror_each_other_to_the_last_bit() {
    let parts = actor_parts();
    let images = mirror_images();
    let elements = &parts.basis.displacements_cm;
    for (at, muscle) in parts.muscles.iter().enumerate() {
        let other_name = other_side(&muscle.name);
        let other = parts
            .muscles
            .iter()
            .position(|it| it.name == other_name)
            .unwrap();
        for (vertex, image) in images.iter().enumerate() {
            let mirrored = mirror(elements[other][*image]);
            assert_eq!(
                elements[at][vertex], mirrored,
                "{} at {vertex}",
                muscle.name
            );
        }
    }
}

#[test]
fn markers_of_the_two_sides_mirror_each_other() {
    let parts = actor_parts();
    let position = |at: usize| place(&parts, at).position(&parts.mesh).0.coords;
    for (at, (marker, _)) in parts.markers.iter().enumerate() {
        // The skin is not smooth at the midline, so that a marker there leans to one half by a few micrometers.
        if !marker.name.contains("_left") && !marker.name.contains("_right") {
            assert!(position(at).x.abs() < 5e-3, "{}", marker.name);
            continue;
        }
        let other_name = other_side(&marker.name);
        let other = parts
            .markers
            .iter()
            .position(|(it, _)| it.name == other_name)
            .unwrap();
        assert!(
            (mirror(position(other)) - position(at)).norm() < 1e-12,
            "{}",
            marker.name
        );
    }
}

#[test]
fn every_edge_has_one_or_two_triangles() {
    let mut edges: HashMap<[u32; 2], usize> = HashMap::new();
    for [a, b, c] in actor_parts().mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    let with = |n_triangles: usize| edges.values().filter(|it| **it == n_triangles).count();
    assert_eq!((with(1), with(2), edges.len()), (216, 4_182, 216 + 4_182));
}

#[test]
fn only_rims_and_a_few_overhangs_face_backwards() {
    let mesh = actor_parts().mesh;
    let backwards = |triangle: &usize| {
        let [a, b, c] = mesh.corners(*triangle).map(|corner| corner.0);
        (b - a).cross(&(c - a)).z <= 0.0
    };
    assert_eq!((0..mesh.triangles.len()).filter(backwards).count(), 56);
}

/// Singular values, falling, of the basis at the 27 markers for one region.
fn singular_values(region: FaceRegion) -> Vec<f64> {
    let parts = actor_parts();
    let of_region: Vec<usize> = (0..parts.muscles.len())
        .filter(|at| parts.muscles[*at].region == region)
        .collect();
    let on_face: Vec<VirtualMarker> = (0..parts.markers.len())
        .filter(|at| parts.markers[*at].0.region == region && !parts.markers[*at].0.head_fixed)
        .map(|at| place(&parts, at))
        .collect();
    let basis = DMatrix::from_fn(3 * on_face.len(), of_region.len(), |row, column| {
        let element = &parts.basis.displacements_cm[of_region[column]];
        let marker = &on_face[row / 3];
        let corners = parts.mesh.triangles[marker.triangle].map(|at| element[at as usize][row % 3]);
        corners
            .iter()
            .zip(marker.barycentric)
            .map(|(it, weight)| it * weight)
            .sum::<f64>()
    });
    basis.singular_values().iter().copied().collect()
}

#[test]
fn the_markers_tell_the_muscles_of_a_region_apart() {
    let rounded = |region| {
        let values = singular_values(region);
        let hundredths = |value: f64| (value * 100.0).round() / 100.0;
        (
            values.len(),
            hundredths(values[0]),
            hundredths(values[values.len() - 1]),
        )
    };
    assert_eq!(rounded(FaceRegion::Upper), (6, 1.75, 0.78));
    assert_eq!(rounded(FaceRegion::Lower), (10, 6.25, 0.38));
}
