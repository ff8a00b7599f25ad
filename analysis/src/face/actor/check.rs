//! The checks of an actor's parts, each in one pass over what it checks.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::{
    ActorError, ActorParts, ActorWarning, MAX_DISPLACEMENTS, MAX_MARKERS, MAX_MUSCLES,
    MAX_TRIANGLES, MAX_VERTICES, NameProblem,
};
use crate::face::mesh::FaceMesh;

/// Longest name of a muscle or marker.
const MAX_NAME_CHARS: usize = 64;
/// Longest id of a muscle vocabulary.
const MAX_ID_CHARS: usize = 63;
/// Longest display name.
const MAX_DISPLAY_NAME_CHARS: usize = 128;

/// A head's scan, with or without neck, in centimeters.
const LIKELY_EXTENT_CM: std::ops::RangeInclusive<f64> = 5.0..=100.0;

pub(super) fn sizes(parts: &ActorParts) -> Result<(), ActorError> {
    let (muscles, vertices) = (parts.muscles.len(), parts.mesh.vertices.len());
    bounded("markers", parts.markers.len(), MAX_MARKERS)?;
    bounded("muscles", muscles, MAX_MUSCLES)?;
    bounded("vertices", vertices, MAX_VERTICES)?;
    bounded("triangles", parts.mesh.triangles.len(), MAX_TRIANGLES)?;
    bounded(
        "displacements (muscles × vertices)",
        muscles * vertices,
        MAX_DISPLACEMENTS,
    )
}

fn bounded(what: &'static str, found: usize, limit: usize) -> Result<(), ActorError> {
    match found {
        0 => Err(ActorError::None { what }),
        _ if found > limit => Err(ActorError::TooMany { what, limit, found }),
        _ => Ok(()),
    }
}

pub(super) fn names(parts: &ActorParts) -> Result<(), ActorError> {
    let single = |what| {
        move |problem| ActorError::Name {
            what,
            index: 0,
            problem,
        }
    };
    display_name(&parts.display_name).map_err(single("display name"))?;
    spelled(
        &parts.muscle_set,
        MAX_ID_CHARS,
        |c| matches!(c, 'a'..='z' | '0'..='9' | '_' | '-'),
    )
    .map_err(single("muscle set"))?;
    unique("muscle", parts.muscles.iter().map(|it| it.name.as_str()))?;
    unique(
        "marker",
        parts.markers.iter().map(|(it, _)| it.name.as_str()),
    )
}

fn unique<'a>(what: &'static str, names: impl Iterator<Item = &'a str>) -> Result<(), ActorError> {
    let mut places = BTreeMap::new();
    for (index, name) in names.enumerate() {
        control_name(name).map_err(|problem| ActorError::Name {
            what,
            index,
            problem,
        })?;
        if let Some(first) = places.insert(name, index) {
            return Err(ActorError::DuplicateName {
                what,
                name: name.to_owned(),
                first,
                second: index,
            });
        }
    }
    Ok(())
}

/// Muscles and markers carry the names that capture systems and rigs give them: `R.Epi.Lat`, `actor:lid 1`.
/// They become column titles and command line arguments, so they are plain ASCII and start with a letter or digit.
fn control_name(name: &str) -> Result<(), NameProblem> {
    spelled(name, MAX_NAME_CHARS, |c| {
        c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.' | ':' | ' ')
    })?;
    match name.chars().next_back() {
        Some(' ') => Err(NameProblem::Character {
            position: name.len() - 1,
            code_point: u32::from(' '),
        }),
        _ => Ok(()),
    }
}

/// A name of letters, digits and what else `allowed` admits; the first is a letter or digit.
fn spelled(name: &str, limit: usize, allowed: impl Fn(char) -> bool) -> Result<(), NameProblem> {
    if name.is_empty() {
        return Err(NameProblem::Empty);
    }
    let fits = |position: usize, c: char| allowed(c) && (position > 0 || c.is_ascii_alphanumeric());
    characters(name, limit, fits)
}

/// A display name is anybody's text, but no terminal or page is driven by it.
fn display_name(name: &str) -> Result<(), NameProblem> {
    if name.trim().is_empty() {
        return Err(NameProblem::Empty);
    }
    characters(name, MAX_DISPLAY_NAME_CHARS, |_, c| {
        !c.is_control() && !changes_direction(c)
    })
}

fn changes_direction(c: char) -> bool {
    matches!(c, '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn characters(
    name: &str,
    limit: usize,
    fits: impl Fn(usize, char) -> bool,
) -> Result<(), NameProblem> {
    for (position, c) in name.chars().enumerate() {
        if position >= limit {
            return Err(NameProblem::TooLong { limit });
        }
        if !fits(position, c) {
            return Err(NameProblem::Character {
                position,
                code_point: u32::from(c),
            });
        }
    }
    Ok(())
}

pub(super) fn mesh(mesh: &FaceMesh) -> Result<(), ActorError> {
    let n_vertices = mesh.vertices.len();
    finite(
        || "neutral face".to_owned(),
        mesh.vertices.iter().map(|vertex| &vertex.0.coords),
    )?;
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&it| it as usize >= n_vertices) {
            return Err(ActorError::FaceIndex {
                triangle,
                vertex,
                n_vertices,
            });
        }
    }
    Ok(())
}

pub(super) fn basis(parts: &ActorParts) -> Result<(), ActorError> {
    let shapes = &parts.basis.displacements_cm;
    if shapes.len() != parts.muscles.len() {
        return Err(ActorError::ShapeCount {
            muscles: parts.muscles.len(),
            shapes: shapes.len(),
        });
    }
    let expected = parts.mesh.vertices.len();
    for (muscle, shape) in parts.muscles.iter().zip(shapes) {
        if shape.len() != expected {
            return Err(ActorError::VertexCount {
                shape: muscle.name.clone(),
                expected,
                found: shape.len(),
            });
        }
        finite(|| format!("shape {}", muscle.name), shape.iter())?;
    }
    Ok(())
}

/// Within the range of `f32`, squares and fourth powers stay finite in `f64`, so the range is checked with it.
fn finite<'a>(
    what: impl Fn() -> String,
    mut vectors: impl Iterator<Item = &'a Vector3<f64>>,
) -> Result<(), ActorError> {
    let fits = |value: f64| value.abs() <= f64::from(f32::MAX);
    match vectors.position(|vector| !vector.iter().all(|&value| fits(value))) {
        Some(vertex) => Err(ActorError::NonFiniteVertex {
            what: what(),
            vertex,
        }),
        None => Ok(()),
    }
}

pub(super) fn oddities(mesh: &FaceMesh) -> Vec<ActorWarning> {
    let flaws = mesh.flaws();
    let degenerate = flaws
        .first_degenerate
        .map(|first| ActorWarning::DegenerateTriangles {
            count: flaws.degenerate_triangles,
            first,
        });
    let isolated = flaws
        .first_isolated
        .map(|first| ActorWarning::IsolatedVertices {
            count: flaws.isolated_vertices,
            first,
        });
    let crowded = flaws
        .first_non_manifold
        .map(|first| ActorWarning::NonManifoldEdges {
            count: flaws.non_manifold_edges,
            first,
        });
    let extent_cm = extent_cm(mesh);
    let extent = (!LIKELY_EXTENT_CM.contains(&extent_cm))
        .then_some(ActorWarning::UnlikelyExtent { extent_cm });
    [degenerate, isolated, crowded, extent]
        .into_iter()
        .flatten()
        .collect()
}

fn extent_cm(mesh: &FaceMesh) -> f64 {
    let Some(first) = mesh.vertices.first() else {
        return 0.0;
    };
    let (low, high) = mesh
        .vertices
        .iter()
        .fold((first.0.coords, first.0.coords), |(low, high), vertex| {
            (low.inf(&vertex.0.coords), high.sup(&vertex.0.coords))
        });
    (high - low).max()
}
