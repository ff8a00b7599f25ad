//! The `f` lines: corners by index from 1, or counted back from the last vertex read.

use super::{MAX_CORNERS, ObjError, ObjProblem};

/// The corners' vertex indices from 0. Positive ones may lie ahead: [`Furthest`] checks them at the end.
pub(super) fn corners<'a>(
    words: impl Iterator<Item = &'a str>,
    n_vertices: usize,
) -> Result<Vec<u32>, ObjProblem> {
    let mut corners = Vec::with_capacity(4);
    for word in words {
        if corners.len() == MAX_CORNERS {
            return Err(ObjProblem::TooManyCorners);
        }
        let vertex = corner(word, n_vertices)?;
        if corners.contains(&vertex) {
            let index = u64::from(vertex) + 1;
            return Err(ObjProblem::RepeatedVertex { index });
        }
        corners.push(vertex);
    }
    match corners.len() {
        found @ 0..3 => Err(ObjProblem::TooFewCorners { found }),
        _ => Ok(corners),
    }
}

/// `7`, `7/2`, `7//3`, `7/2/3` or `-1`: only the vertex counts.
fn corner(word: &str, n_vertices: usize) -> Result<u32, ObjProblem> {
    let vertex = word.split('/').next().unwrap_or(word);
    let index: i64 = vertex.parse().map_err(|_| ObjProblem::CornerSyntax)?;
    let beyond = ObjProblem::IndexBeyond { index, n_vertices };
    let from_zero = match index {
        0 => return Err(ObjProblem::IndexZero),
        1.. => index.checked_sub(1),
        ..0 => i64::try_from(n_vertices)
            .ok()
            .and_then(|count| count.checked_add(index)),
    };
    from_zero
        .and_then(|it| u32::try_from(it).ok())
        .ok_or(beyond)
}

/// The triangles of a polygon, all from its first corner.
pub(super) fn fanned(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    corners
        .windows(2)
        .skip(1)
        .map(|pair| [corners[0], pair[0], pair[1]])
}

/// The highest vertex that any face names, and where, so that faces may come before their vertices.
#[derive(Default)]
pub(super) struct Furthest {
    vertex: Option<u32>,
    line: usize,
}

impl Furthest {
    pub(super) fn note(&mut self, corners: &[u32], line: usize) {
        let highest = corners.iter().copied().max();
        if highest > self.vertex {
            self.vertex = highest;
            self.line = line;
        }
    }

    pub(super) fn check(&self, n_vertices: usize) -> Result<(), ObjError> {
        match self.vertex {
            Some(vertex) if vertex as usize >= n_vertices => Err(ObjError {
                line: self.line,
                problem: ObjProblem::IndexBeyond {
                    index: i64::from(vertex) + 1,
                    n_vertices,
                },
            }),
            _ => Ok(()),
        }
    }
}
