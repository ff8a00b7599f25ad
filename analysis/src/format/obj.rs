//! Wavefront OBJ: the vertices and faces of a neutral face or a muscle's shape.
//!
//! `v` and `f` lines count; normals, texture coordinates, groups and materials are skipped. Polygons are fanned from
//! their first corner, so a face of k corners is k − 2 triangles in a row.

mod error;
mod face;

use std::fmt::Write as _;

pub use error::{ObjError, ObjProblem};

use crate::face::actor::{MAX_TRIANGLES, MAX_VERTICES};

/// Longest line, in bytes without its end; the OBJ format itself sets none.
pub const MAX_LINE_BYTES: usize = 64 * 1024;
/// Most corners of one face.
pub const MAX_CORNERS: usize = 64;

/// What of an OBJ matters here, in the file's unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Obj {
    /// Coordinates of each vertex; finite and within the range of `f32`.
    pub vertices: Vec<[f64; 3]>,
    /// Fanned faces, vertex indices from 0; empty when the file has none.
    pub triangles: Vec<[u32; 3]>,
}

/// Reads an OBJ.
///
/// # Errors
///
/// The first line that cannot be used, by its number from 1.
pub fn parse(bytes: &[u8]) -> Result<Obj, ObjError> {
    let mut obj = Obj::default();
    let mut furthest = face::Furthest::default();
    let mut line = 0;
    for raw in without_bom(bytes).split(|&byte| byte == b'\n') {
        line += 1;
        let at = |problem| ObjError { line, problem };
        let text = plain(raw).map_err(at)?;
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                if obj.vertices.len() == MAX_VERTICES {
                    return Err(at(ObjProblem::TooManyVertices));
                }
                obj.vertices.push(coordinates(words).map_err(at)?);
            }
            Some("f") => {
                let corners = face::corners(words, obj.vertices.len()).map_err(at)?;
                furthest.note(&corners, line);
                if obj.triangles.len() + corners.len() - 2 > MAX_TRIANGLES {
                    return Err(at(ObjProblem::TooManyTriangles));
                }
                obj.triangles.extend(face::fanned(&corners));
            }
            _ => {}
        }
    }
    if obj.vertices.is_empty() {
        let problem = ObjProblem::NoVertices;
        return Err(ObjError { line, problem });
    }
    furthest.check(obj.vertices.len())?;
    Ok(obj)
}

fn without_bom(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// A line's text without its comment.
fn plain(raw: &[u8]) -> Result<&str, ObjProblem> {
    if raw.len() > MAX_LINE_BYTES {
        return Err(ObjProblem::LineTooLong);
    }
    if raw.contains(&0) {
        return Err(ObjProblem::Nul);
    }
    let text = str::from_utf8(raw).map_err(|_| ObjProblem::NotUtf8)?;
    Ok(text.split('#').next().unwrap_or(text))
}

/// Three coordinates; what may follow (a weight, a color) must be numbers and is skipped.
fn coordinates<'a>(words: impl Iterator<Item = &'a str>) -> Result<[f64; 3], ObjProblem> {
    const WITH_WEIGHT_AND_COLOR: usize = 7;
    let mut numbers = [0.0; WITH_WEIGHT_AND_COLOR];
    let mut found = 0;
    for word in words {
        *numbers
            .get_mut(found)
            .ok_or(ObjProblem::Coordinates { found: found + 1 })? = number(word)?;
        found += 1;
    }
    match found {
        0..3 => Err(ObjProblem::Coordinates { found }),
        _ => Ok([numbers[0], numbers[1], numbers[2]]),
    }
}

/// `f64` parsing accepts `nan`, `inf`, and overflows to infinity; none of them is a coordinate.
fn number(word: &str) -> Result<f64, ObjProblem> {
    let value: f64 = word.parse().map_err(|_| ObjProblem::NotANumber)?;
    if value.abs() <= f64::from(f32::MAX) {
        Ok(value)
    } else {
        Err(ObjProblem::NonFinite)
    }
}

/// Writes an OBJ whose numbers read back to the same bits.
pub fn write(vertices: impl IntoIterator<Item = [f64; 3]>, triangles: &[[u32; 3]]) -> String {
    let mut text = String::new();
    for [x, y, z] in vertices {
        writeln!(text, "v {x} {y} {z}").expect("invariant: a String accepts every write");
    }
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| u64::from(vertex) + 1);
        writeln!(text, "f {a} {b} {c}").expect("invariant: a String accepts every write");
    }
    text
}

#[cfg(test)]
mod tests;
