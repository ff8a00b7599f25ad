//! Where the 27 markers and the 5 head-fixed ones sit on the reference face.
//!
//! A marker is bound to the closest point of the skin; rims are left out, and a lip's marker stays on its own lip.

use super::{depth::depth_cm, grid::SkinVertex};
use crate::{
    face::{
        marker::{Marker, VirtualMarker},
        mesh::FaceMesh,
        region::FaceRegion::{self, Lower, Upper},
    },
    space::ModelPoint,
};

/// What part of the skin may carry a marker.
#[derive(Clone, Copy)]
enum Site {
    Face,
    UpperLip,
    LowerLip,
    /// Rides on the skull.
    Head,
}
use Site::{Face, Head, LowerLip, UpperLip};

/// A marker of the midline has two closest points, one a half; this much towards one of them decides for good,
/// where rounding would decide anew on every machine.
const TO_LEFT_CM: f64 = 1e-9;
const TO_RIGHT_CM: f64 = -TO_LEFT_CM;

/// Name, x and y in centimeters, region, site.
#[rustfmt::skip]
const MARKERS: [(&str, f64, f64, FaceRegion, Site); 32] = [
    ("forehead_left", 2.6, 4.7, Upper, Face),
    ("forehead_right", -2.6, 4.7, Upper, Face),
    ("brow_inner_left", 1.3, 1.85, Upper, Face),
    ("brow_inner_right", -1.3, 1.85, Upper, Face),
    ("brow_middle_left", 3.1, 2.4, Upper, Face),
    ("brow_middle_right", -3.1, 2.4, Upper, Face),
    ("brow_outer_left", 4.9, 2.0, Upper, Face),
    ("brow_outer_right", -4.9, 2.0, Upper, Face),
    ("lid_left", 3.1, 0.66, Upper, Face),
    ("lid_right", -3.1, 0.66, Upper, Face),
    ("nose_bridge", TO_RIGHT_CM, -0.4, Upper, Face),
    ("nose_tip", TO_RIGHT_CM, -4.0, Lower, Face),
    ("ala_left", 1.45, -4.3, Lower, Face),
    ("ala_right", -1.45, -4.3, Lower, Face),
    ("cheek_left", 3.9, -3.0, Lower, Face),
    ("cheek_right", -3.9, -3.0, Lower, Face),
    ("jowl_left", 4.3, -6.4, Lower, Face),
    ("jowl_right", -4.3, -6.4, Lower, Face),
    ("mouth_corner_left", 2.62, -7.02, Lower, Face),
    ("mouth_corner_right", -2.62, -7.02, Lower, Face),
    ("upper_lip_middle", TO_RIGHT_CM, -6.35, Lower, UpperLip),
    ("upper_lip_left", 1.2, -6.42, Lower, UpperLip),
    ("upper_lip_right", -1.2, -6.42, Lower, UpperLip),
    ("lower_lip_middle", TO_LEFT_CM, -7.75, Lower, LowerLip),
    ("lower_lip_left", 1.2, -7.6, Lower, LowerLip),
    ("lower_lip_right", -1.2, -7.6, Lower, LowerLip),
    ("chin", TO_RIGHT_CM, -9.8, Lower, Face),
    ("head_left", 4.6, 5.6, Upper, Head),
    ("head_right", -4.6, 5.6, Upper, Head),
    ("head_top", TO_RIGHT_CM, 7.2, Upper, Head),
    ("temple_left", 6.5, 1.6, Upper, Head),
    ("temple_right", -6.5, 1.6, Upper, Head),
];

/// Every marker with its place on the skin, which is `mesh` with `vertices` telling what each vertex is.
pub(super) fn markers(mesh: &FaceMesh, vertices: &[SkinVertex]) -> Vec<(Marker, VirtualMarker)> {
    let bind = |(name, x, y, region, site): (&str, f64, f64, FaceRegion, Site)| {
        let marker = Marker {
            name: name.to_owned(),
            region,
            head_fixed: matches!(site, Head),
        };
        let carries = |triangle: usize| {
            let mut corners = mesh.triangles[triangle].iter();
            corners.all(|&corner| carries(&vertices[corner as usize], site))
        };
        let bound = mesh.closest_point(ModelPoint::new(x, y, depth_cm(x, y)), carries);
        (
            marker,
            bound.expect("invariant: every site has triangles").place,
        )
    };
    MARKERS.map(bind).into()
}

fn carries(corner: &SkinVertex, site: Site) -> bool {
    let right_side = match site {
        Face | Head => true,
        UpperLip => !corner.below_mouth(),
        LowerLip => corner.below_mouth(),
    };
    right_side && !corner.rim
}
