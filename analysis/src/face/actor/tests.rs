//! An actor small enough to read, and what is refused of it.

use nalgebra::Vector3;

use super::*;
use crate::face::region::FaceRegion;

/// A flat 5 × 5 sheet, 10 cm wide, with markers on it and muscles that each pull another corner.
pub(crate) fn sheet() -> ActorParts {
    const SIDE: u32 = 5;
    let at = |index: u32| (f64::from(index % SIDE) * 2.5, f64::from(index / SIDE) * 2.5);
    let vertices: Vec<_> = (0..SIDE * SIDE).map(at).collect();
    let quads = (0..SIDE * SIDE).filter(|it| it % SIDE + 1 < SIDE && it / SIDE + 1 < SIDE);
    let fan = |a: u32| [[a, a + 1, a + SIDE + 1], [a, a + SIDE + 1, a + SIDE]];
    let pull = |x: f64, y: f64, towards: Vector3<f64>| {
        let weight = |&(u, v): &(f64, f64)| (-((u - x).powi(2) + (v - y).powi(2)) / 9.0).exp();
        vertices.iter().map(|it| towards * weight(it)).collect()
    };
    let muscle = |name: &str, region| Muscle {
        name: name.to_owned(),
        region,
    };
    let marker = |name: &str, region, head_fixed| Marker {
        name: name.to_owned(),
        region,
        head_fixed,
    };
    ActorParts {
        display_name: "Sheet".to_owned(),
        muscle_set: "sheet-3".to_owned(),
        mesh: FaceMesh {
            vertices: vertices
                .iter()
                .map(|&(x, y)| ModelPoint::new(x, y, 0.0))
                .collect(),
            triangles: quads.flat_map(fan).collect(),
        },
        muscles: vec![
            muscle("raiser_left", FaceRegion::Upper),
            muscle("raiser_right", FaceRegion::Upper),
            muscle("puller", FaceRegion::Lower),
        ],
        basis: ActuationBasis {
            displacements_cm: vec![
                pull(2.0, 8.0, Vector3::new(0.0, 1.0, 0.2)),
                pull(8.0, 8.0, Vector3::new(0.0, 1.0, 0.2)),
                pull(5.0, 2.0, Vector3::new(0.5, -0.5, 0.5)),
            ],
        },
        markers: vec![
            (
                marker("brow_left", FaceRegion::Upper, false),
                MarkerPlace::Position(ModelPoint::new(2.1, 8.2, 0.3)),
            ),
            (
                marker("brow_right", FaceRegion::Upper, false),
                MarkerPlace::Vertex(23),
            ),
            (
                marker("lip", FaceRegion::Lower, false),
                MarkerPlace::OnTriangle(VirtualMarker {
                    triangle: 4,
                    barycentric: [0.2, 0.5, 0.3],
                }),
            ),
            (
                marker("headband", FaceRegion::Upper, true),
                MarkerPlace::Position(ModelPoint::new(5.0, 10.0, 0.0)),
            ),
        ],
    }
}

fn refused(change: impl FnOnce(&mut ActorParts)) -> ActorError {
    let mut parts = sheet();
    change(&mut parts);
    Actor::new(parts, RankPolicy::Refuse).unwrap_err()
}

fn accepted(change: impl FnOnce(&mut ActorParts)) -> (Actor, Vec<ActorWarning>) {
    let mut parts = sheet();
    change(&mut parts);
    Actor::new(parts, RankPolicy::Refuse).unwrap()
}

fn placed(barycentric: [f64; 3], triangle: usize) -> impl FnOnce(&mut ActorParts) {
    move |parts| {
        parts.markers[2].1 = MarkerPlace::OnTriangle(VirtualMarker {
            triangle,
            barycentric,
        });
    }
}

#[test]
fn a_sound_actor_is_accepted_without_a_warning_and_bound_to_its_surface() {
    let (actor, warnings) = accepted(|_| {});
    assert_eq!(warnings, []);
    let positions: Vec<_> = actor
        .virtual_markers()
        .iter()
        .map(|it| it.position(actor.mesh()))
        .collect();
    assert!((positions[0].0 - ModelPoint::new(2.1, 8.2, 0.0).0).norm() < 1e-12);
    assert_eq!(positions[1], actor.mesh().vertices[23]);
    let given = VirtualMarker {
        triangle: 4,
        barycentric: [0.2, 0.5, 0.3],
    };
    assert_eq!(actor.virtual_markers()[2], given);
}

#[test]
fn the_parts_of_an_actor_make_the_same_actor() {
    let (actor, _) = accepted(|_| {});
    let (again, warnings) = Actor::new(actor.to_parts(), RankPolicy::Refuse).unwrap();
    assert_eq!(again, actor);
    assert_eq!(warnings, []);
}

#[test]
fn head_fixed_markers_do_not_move_with_muscles() {
    let (actor, _) = accepted(|_| {});
    let basis = actor.marker_basis();
    assert!(basis.of_marker_cm(3).iter().all(|d| *d == Vector3::zeros()));
    assert!(basis.of_marker_cm(0)[0].norm() > 0.5);
    assert_eq!((basis.n_markers(), basis.n_muscles()), (4, 3));
}

#[test]
fn c6_weights_that_do_not_sum_to_one_are_refused() {
    let error = refused(placed([0.2, 0.5, 0.300_01], 4));
    assert_eq!(error.reason(), "BARYCENTRIC");
    assert!(
        error
            .to_string()
            .starts_with("marker lip: its weights sum to 1.00001"),
        "{error}"
    );
    accepted(placed([0.2, 0.5, 0.300_000_5], 4));
}

#[test]
fn c6_negative_and_non_finite_weights_are_refused() {
    for weights in [
        [-0.1, 0.6, 0.5],
        [f64::NAN, 0.5, 0.5],
        [f64::INFINITY, 0.0, 0.0],
    ] {
        assert_eq!(refused(placed(weights, 4)).reason(), "BARYCENTRIC");
    }
}

#[test]
fn c6_a_triangle_out_of_range_is_refused() {
    let error = refused(placed([0.2, 0.5, 0.3], 32));
    assert_eq!(
        error.to_string(),
        "marker lip: there is no triangle 32, the mesh has 32"
    );
    let error = refused(|parts| parts.markers[1].1 = MarkerPlace::Vertex(25));
    assert_eq!(
        error.to_string(),
        "marker brow_right: there is no vertex 25, the mesh has 25"
    );
}

#[test]
fn c6_a_marker_on_a_degenerate_triangle_is_refused() {
    let error = refused(|parts| {
        parts.mesh.triangles[4] = [0, 1, 2];
        placed([0.2, 0.5, 0.3], 4)(parts);
    });
    assert_eq!(error.to_string(), "marker lip: triangle 4 has no area");
}

#[test]
fn d5_degenerate_triangles_isolated_vertices_and_crowded_edges_are_warned_of() {
    let (actor, warnings) = accepted(|parts| {
        parts.mesh.triangles.push([0, 1, 2]);
        parts.mesh.triangles.push([0, 1, 12]);
        parts.mesh.triangles.push([0, 1, 13]);
        parts.mesh.vertices.push(ModelPoint::new(5.0, 5.0, 5.0));
        for shape in &mut parts.basis.displacements_cm {
            shape.push(Vector3::zeros());
        }
        parts.markers[0].1 = MarkerPlace::Position(ModelPoint::new(1.0, 0.0, 0.0));
    });
    assert_eq!(
        warnings,
        [
            ActorWarning::DegenerateTriangles {
                count: 1,
                first: 32
            },
            ActorWarning::IsolatedVertices {
                count: 1,
                first: 25
            },
            ActorWarning::NonManifoldEdges {
                count: 1,
                first: [0, 1]
            },
        ]
    );
    let degenerate = |it: &VirtualMarker| actor.mesh().is_degenerate(it.triangle);
    assert!(!actor.virtual_markers().iter().any(degenerate));
}

#[test]
fn d5_a_mesh_without_any_area_carries_no_marker() {
    let error = refused(|parts| parts.mesh.triangles = vec![[0, 1, 2]]);
    assert_eq!(error.reason(), "BARYCENTRIC");
}

#[test]
fn d1_a_duplicate_column_is_refused_naming_both() {
    let error = refused(|parts| {
        parts.basis.displacements_cm[1] = parts.basis.displacements_cm[0].clone();
    });
    let ActorError::BasisRank { columns, condition } = &error else {
        panic!("{error}");
    };
    assert_eq!(columns, &["raiser_left", "raiser_right"]);
    assert!(*condition > 1e6);
    assert_eq!(error.reason(), "BASIS_RANK");
}

#[test]
fn d1_a_scaled_column_is_refused_even_when_it_was_rounded() {
    let round = |value: f64| (value * 1e5).round() / 1e5;
    let error = refused(|parts| {
        let scaled = parts.basis.displacements_cm[0].iter();
        parts.basis.displacements_cm[2] = scaled.map(|d| (d * -0.37).map(round)).collect();
    });
    let ActorError::BasisRank { columns, condition } = &error else {
        panic!("{error}");
    };
    assert_eq!(columns, &["raiser_left", "puller"]);
    assert!(condition.is_finite(), "{condition}");
}

#[test]
fn d1_a_column_that_moves_no_marker_is_refused() {
    let error = refused(|parts| parts.basis.displacements_cm[1].fill(Vector3::zeros()));
    assert_eq!(
        error.to_string(),
        "the basis is rank-deficient at the markers (condition number inf): raiser_right"
    );
}

#[test]
fn d1_a_rank_deficient_basis_is_accepted_and_reported_on_request() {
    let mut parts = sheet();
    parts.basis.displacements_cm[1].fill(Vector3::zeros());
    let (actor, warnings) = Actor::new(parts, RankPolicy::Regularize).unwrap();
    assert!(
        matches!(&warnings[..], [ActorWarning::BasisRank { columns, .. }] if columns == &["raiser_right"])
    );
    assert!(actor.basis_report().condition_upper.is_infinite());
}

#[test]
fn d2_a_shape_with_another_number_of_vertices_is_refused() {
    let error = refused(|parts| {
        parts.basis.displacements_cm[2].pop();
    });
    assert_eq!(
        error.to_string(),
        "shape puller has 24 vertices, the neutral face has 25"
    );
    assert_eq!(error.reason(), "VERTEX_COUNT");
}

#[test]
fn d3_non_finite_coordinates_are_refused() {
    for value in [f64::NAN, f64::INFINITY, 1e39] {
        let vertex = refused(|parts| parts.mesh.vertices[7].0.y = value);
        assert_eq!(
            vertex.to_string(),
            "neutral face, vertex 7: a coordinate is not a finite number"
        );
        let shape = refused(|parts| parts.basis.displacements_cm[0][3].z = value);
        assert_eq!(shape.reason(), "NON_FINITE");
        let marker = refused(|parts| {
            parts.markers[0].1 = MarkerPlace::Position(ModelPoint::new(0.0, value, 0.0));
        });
        assert_eq!(marker.reason(), "NON_FINITE");
    }
}

#[test]
fn d4_a_triangle_beyond_the_vertices_is_refused() {
    let error = refused(|parts| parts.mesh.triangles[3][1] = 25);
    assert_eq!(
        error.to_string(),
        "triangle 3 names vertex 25, the mesh has 25"
    );
}

#[test]
fn d7_every_limit_is_named_with_its_value() {
    let error = refused(|parts| {
        parts.mesh.vertices = vec![ModelPoint::new(0.0, 0.0, 0.0); MAX_VERTICES + 1];
    });
    assert_eq!(
        error.to_string(),
        "200001 vertices, at most 200000 are accepted"
    );
    let error = refused(|parts| parts.mesh.triangles = vec![[0, 1, 2]; MAX_TRIANGLES + 1]);
    assert_eq!(error.reason(), "BASIS_SIZE");
    let error = refused(|parts| parts.markers = vec![parts.markers[0].clone(); MAX_MARKERS + 1]);
    assert_eq!(error.reason(), "BASIS_SIZE");
    let error = refused(|parts| parts.muscles = vec![parts.muscles[0].clone(); MAX_MUSCLES + 1]);
    assert_eq!(error.reason(), "BASIS_SIZE");
}

#[test]
fn i5_names_that_could_do_harm_are_refused() {
    let long = "x".repeat(1_000_000);
    let names = [
        "",
        " ",
        "../x",
        "/etc",
        "C:\\",
        "a\0",
        "a\n",
        "\u{1b}[31m",
        "a\u{202e}b",
        &long,
        ".",
        "🙂",
        "e\u{301}",
        "раsswd",
        "=1+1",
        "a ",
        "a,b",
        "\"a\"",
    ];
    for name in names {
        let error = refused(|parts| parts.muscles[1].name = name.to_owned());
        assert_eq!(error.reason(), "NAME", "{name:?}");
        let error = refused(|parts| parts.markers[1].0.name = name.to_owned());
        assert_eq!(error.reason(), "NAME", "{name:?}");
        assert!(error.to_string().is_ascii());
    }
    for name in ["", "\t", "a\u{202e}b", "a\nb", &long] {
        let error = refused(|parts| parts.display_name = name.to_owned());
        assert_eq!(error.reason(), "NAME", "{name:?}");
    }
    for name in ["BrowDownLeft", "R.Epi.Lat", "zygomaticus_L", "actor:lid 1"] {
        accepted(|parts| parts.markers[1].0.name = name.to_owned());
    }
    accepted(|parts| parts.display_name = "Zoë 🙂 = 최".to_owned());
}

#[test]
fn i5_two_muscles_or_markers_of_one_name_are_refused() {
    let error = refused(|parts| parts.muscles[2].name = parts.muscles[0].name.clone());
    assert_eq!(
        error.to_string(),
        "muscle 0 and muscle 2 are both named raiser_left"
    );
    let error = refused(|parts| parts.markers[3].0.name = parts.markers[1].0.name.clone());
    assert_eq!(error.reason(), "NAME");
}

#[test]
fn a_face_in_meters_is_warned_of() {
    let (_, warnings) = accepted(|parts| {
        for vertex in &mut parts.mesh.vertices {
            vertex.0 /= 100.0;
        }
    });
    assert!(
        matches!(warnings[0], ActorWarning::UnlikelyExtent { extent_cm } if (extent_cm - 0.1).abs() < 1e-12)
    );
    assert!(
        matches!(&warnings[1], ActorWarning::MarkerOffSurface { marker, .. } if marker == "brow_left")
    );
}

#[test]
fn the_report_names_muscles_that_look_alike() {
    let (actor, _) = accepted(|parts| {
        let leaning = Vector3::new(0.2, 0.0, 0.0);
        let alike = parts.basis.displacements_cm[0].iter();
        parts.basis.displacements_cm[1] = alike.map(|d| -(d + leaning * d.y)).collect();
    });
    let report = actor.basis_report();
    assert_eq!(report.ambiguous.len(), 1);
    let pair = &report.ambiguous[0];
    assert_eq!((pair.first, pair.second), (0, 1));
    assert!((-1.0..-0.9).contains(&pair.correlation), "{pair:?}");
    assert!(report.condition_upper > 1.0 && report.condition_lower >= 1.0);
}
