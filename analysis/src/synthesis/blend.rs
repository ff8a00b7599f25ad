//! The face of a contraction vector: E = E₀ + Σ xᵢeᵢ (Choe & Ko 2001, equation 1).

use crate::{
    face::{basis::ActuationBasis, mesh::FaceMesh},
    space::ModelPoint,
};

/// Why a face could not be synthesized.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BlendError {
    /// One contraction a muscle is needed.
    #[error("{found} contractions for a basis of {expected} muscles")]
    MuscleCount {
        /// Muscles of the basis.
        expected: usize,
        /// Contractions given.
        found: usize,
    },
    /// A basis element must move every vertex of the neutral face.
    #[error("basis element {muscle_idx} has {found} vertices, the neutral face has {expected}")]
    VertexCount {
        /// The muscle whose element differs.
        muscle_idx: usize,
        /// Vertices of the neutral face.
        expected: usize,
        /// Vertices of the basis element.
        found: usize,
    },
}

/// Writes the vertices of the face at `contractions` into `vertices`, whose memory is reused.
///
/// `contractions` has one entry a muscle; a muscle at rest costs nothing.
/// Values outside [0, 1] extrapolate, as the paper's equation does.
///
/// # Errors
///
/// [`BlendError`] when the three disagree on the number of muscles or vertices; `vertices` is then unchanged.
///
/// ```
/// use frontalis_analysis::synthesis::{blend, reference_face};
///
/// let parts = reference_face::actor_parts();
/// let mut contractions = vec![0.0; parts.muscles.len()];
/// contractions[0] = 0.5;
/// let mut vertices = Vec::new();
/// blend::blend(&parts.mesh, &parts.basis, &contractions, &mut vertices)?;
/// assert_eq!(vertices.len(), parts.mesh.vertices.len());
/// # Ok::<(), blend::BlendError>(())
/// ```
pub fn blend(
    neutral: &FaceMesh,
    basis: &ActuationBasis,
    contractions: &[f64],
    vertices: &mut Vec<ModelPoint>,
) -> Result<(), BlendError> {
    check(neutral, basis, contractions)?;
    vertices.clear();
    vertices.extend_from_slice(&neutral.vertices);
    for (element, &contraction) in basis.displacements_cm.iter().zip(contractions) {
        if contraction == 0.0 {
            continue;
        }
        for (vertex, displacement) in vertices.iter_mut().zip(element) {
            vertex.0 += displacement * contraction;
        }
    }
    Ok(())
}

fn check(
    neutral: &FaceMesh,
    basis: &ActuationBasis,
    contractions: &[f64],
) -> Result<(), BlendError> {
    let n_muscles = basis.displacements_cm.len();
    if contractions.len() != n_muscles {
        return Err(BlendError::MuscleCount {
            expected: n_muscles,
            found: contractions.len(),
        });
    }
    let expected = neutral.vertices.len();
    let mut elements = basis.displacements_cm.iter().enumerate();
    match elements.find(|(_, element)| element.len() != expected) {
        Some((muscle_idx, element)) => Err(BlendError::VertexCount {
            muscle_idx,
            expected,
            found: element.len(),
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    fn two_vertices() -> (FaceMesh, ActuationBasis) {
        let mesh = FaceMesh {
            vertices: vec![
                ModelPoint::new(0.0, 0.0, 0.0),
                ModelPoint::new(1.0, 2.0, 3.0),
            ],
            triangles: Vec::new(),
        };
        let basis = ActuationBasis {
            displacements_cm: vec![
                vec![Vector3::x(), Vector3::zeros()],
                vec![Vector3::y(), Vector3::z() * 2.0],
            ],
        };
        (mesh, basis)
    }

    #[test]
    fn adds_every_element_in_proportion_to_its_contraction() {
        let (mesh, basis) = two_vertices();
        let mut vertices = vec![ModelPoint::new(9.0, 9.0, 9.0); 7];
        blend(&mesh, &basis, &[0.5, 0.25], &mut vertices).unwrap();
        assert_eq!(
            vertices,
            [
                ModelPoint::new(0.5, 0.25, 0.0),
                ModelPoint::new(1.0, 2.0, 3.5)
            ]
        );
    }

    #[test]
    fn refuses_a_vector_or_a_basis_of_another_length() {
        let (mesh, mut basis) = two_vertices();
        let mut vertices = Vec::new();
        let muscles = blend(&mesh, &basis, &[0.5], &mut vertices).unwrap_err();
        assert_eq!(
            muscles,
            BlendError::MuscleCount {
                expected: 2,
                found: 1
            }
        );
        basis.displacements_cm[1].pop();
        let shorter = blend(&mesh, &basis, &[0.5, 0.5], &mut vertices).unwrap_err();
        assert_eq!(
            shorter,
            BlendError::VertexCount {
                muscle_idx: 1,
                expected: 2,
                found: 1
            }
        );
        assert!(vertices.is_empty());
    }
}
