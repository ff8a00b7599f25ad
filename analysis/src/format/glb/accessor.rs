//! The bytes behind accessors, with every offset checked.
//!
//! Element i of an accessor lies at view.offset + accessor.offset + i × stride (glTF 2.0, section 3.6.2.4); a sparse
//! accessor replaces some elements of that, or of zeros (section 3.6.2.3).

use gltf::json::{
    self,
    accessor::{Accessor, ComponentType, GenericComponentType, Type, sparse::Sparse},
    validation::{Checked, USize64},
};

use super::{AccessorProblem, GlbError};
use crate::face::actor::{MAX_TRIANGLES, MAX_VERTICES};

/// The most elements any accessor of an accepted mesh can have.
const MAX_ELEMENTS: usize = if MAX_VERTICES > 3 * MAX_TRIANGLES {
    MAX_VERTICES
} else {
    3 * MAX_TRIANGLES
};

const VECTOR_BYTES: usize = 12;

/// A document beside its binary chunk.
pub(super) struct Binary<'a> {
    pub(super) root: &'a json::Root,
    pub(super) bytes: &'a [u8],
}

/// Where equally long elements lie: one view's bytes from the first element on.
#[derive(Clone, Copy)]
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    fn iter(self) -> impl Iterator<Item = &'a [u8]> {
        (0..self.count).map(move |index| &self.bytes[index * self.stride..][..self.size])
    }
}

impl Binary<'_> {
    /// The number of elements an accessor claims.
    pub(super) fn count(&self, index: json::Index<Accessor>) -> Option<usize> {
        let accessor = self.root.accessors.get(index.value())?;
        usize::try_from(accessor.count.0).ok()
    }

    /// The elements of a `VEC3` accessor of `f32`.
    pub(super) fn vectors(&self, index: json::Index<Accessor>) -> Result<Vec<[f32; 3]>, GlbError> {
        self.read_vectors(index).map_err(at(index))
    }

    /// The elements of a `SCALAR` accessor of unsigned integers.
    pub(super) fn indices(&self, index: json::Index<Accessor>) -> Result<Vec<u32>, GlbError> {
        self.read_indices(index).map_err(at(index))
    }

    fn read_vectors(&self, index: json::Index<Accessor>) -> Result<Vec<[f32; 3]>, AccessorProblem> {
        let (accessor, kind, component) = self.typed(index)?;
        if kind != Type::Vec3 || component != ComponentType::F32 || accessor.normalized {
            return Err(AccessorProblem::Type);
        }
        let count = size(accessor.count)?;
        let mut vectors = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset.unwrap_or_default();
                let elements = self.elements(view, offset, VECTOR_BYTES, count)?;
                elements.iter().map(vector).collect()
            }
            None if count <= MAX_ELEMENTS => vec![[0.0; 3]; count],
            None => return Err(AccessorProblem::Count),
        };
        if let Some(sparse) = &accessor.sparse {
            self.replace(&mut vectors, sparse)?;
        }
        Ok(vectors)
    }

    fn replace(&self, vectors: &mut [[f32; 3]], sparse: &Sparse) -> Result<(), AccessorProblem> {
        let count = size(sparse.count)?;
        let Checked::Valid(component) = sparse.indices.component_type else {
            return Err(AccessorProblem::Type);
        };
        let places = &sparse.indices;
        let places = self.integers(places.buffer_view, places.byte_offset, component.0, count)?;
        let values = &sparse.values;
        let values = self.elements(values.buffer_view, values.byte_offset, VECTOR_BYTES, count)?;
        let mut next = 0;
        for (place, value) in places.into_iter().zip(values.iter()) {
            let place = place as usize;
            if place < next || place >= vectors.len() {
                return Err(AccessorProblem::SparseIndices);
            }
            vectors[place] = vector(value);
            next = place + 1;
        }
        Ok(())
    }

    fn read_indices(&self, index: json::Index<Accessor>) -> Result<Vec<u32>, AccessorProblem> {
        let (accessor, kind, component) = self.typed(index)?;
        if kind != Type::Scalar || accessor.normalized || accessor.sparse.is_some() {
            return Err(AccessorProblem::Type);
        }
        let view = accessor.buffer_view.ok_or(AccessorProblem::Dangling)?;
        let offset = accessor.byte_offset.unwrap_or_default();
        self.integers(view, offset, component, size(accessor.count)?)
    }

    fn typed(
        &self,
        index: json::Index<Accessor>,
    ) -> Result<(&Accessor, Type, ComponentType), AccessorProblem> {
        let accessor = self
            .root
            .accessors
            .get(index.value())
            .ok_or(AccessorProblem::Dangling)?;
        match (accessor.type_, accessor.component_type) {
            (Checked::Valid(kind), Checked::Valid(GenericComponentType(component))) => {
                Ok((accessor, kind, component))
            }
            _ => Err(AccessorProblem::Type),
        }
    }

    fn integers(
        &self,
        view: json::Index<json::buffer::View>,
        offset: USize64,
        component: ComponentType,
        count: usize,
    ) -> Result<Vec<u32>, AccessorProblem> {
        let size = match component {
            ComponentType::U8 => 1,
            ComponentType::U16 => 2,
            ComponentType::U32 => 4,
            _ => return Err(AccessorProblem::Type),
        };
        let elements = self.elements(view, offset, size, count)?;
        Ok(elements.iter().map(integer).collect())
    }

    /// Finds `count` elements of `element_bytes` in a view; the whole of each lies in the binary chunk.
    fn elements(
        &self,
        view: json::Index<json::buffer::View>,
        offset: USize64,
        element_bytes: usize,
        count: usize,
    ) -> Result<Elements<'_>, AccessorProblem> {
        if count == 0 {
            return Err(AccessorProblem::Empty);
        }
        let views = &self.root.buffer_views;
        let view = views.get(view.value()).ok_or(AccessorProblem::Dangling)?;
        if view.buffer.value() != 0 || self.root.buffers.is_empty() {
            return Err(AccessorProblem::Dangling);
        }
        let stride = view.byte_stride.map_or(element_bytes, |stride| stride.0);
        if stride < element_bytes {
            return Err(AccessorProblem::Stride);
        }
        let start = size(view.byte_offset.unwrap_or_default())?;
        let bytes = self
            .bytes
            .get(start..)
            .and_then(|bytes| bytes.get(..size(view.byte_length).ok()?))
            .and_then(|bytes| bytes.get(size(offset).ok()?..))
            .ok_or(AccessorProblem::Outside)?;
        let end = stride
            .checked_mul(count - 1)
            .and_then(|last| last.checked_add(element_bytes))
            .ok_or(AccessorProblem::Outside)?;
        if end > bytes.len() {
            return Err(AccessorProblem::Outside);
        }
        Ok(Elements {
            bytes,
            stride,
            size: element_bytes,
            count,
        })
    }
}

fn at(index: json::Index<Accessor>) -> impl Fn(AccessorProblem) -> GlbError {
    move |problem| GlbError::Accessor {
        accessor: index.value(),
        problem,
    }
}

fn size(length: USize64) -> Result<usize, AccessorProblem> {
    usize::try_from(length.0).map_err(|_| AccessorProblem::Outside)
}

fn vector(bytes: &[u8]) -> [f32; 3] {
    let component =
        |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
    [component(0), component(4), component(8)]
}

/// A little-endian integer of one, two or four bytes.
fn integer(bytes: &[u8]) -> u32 {
    let bytes = bytes.iter().rev();
    bytes.fold(0, |sum, &byte| sum << 8 | u32::from(byte))
}
