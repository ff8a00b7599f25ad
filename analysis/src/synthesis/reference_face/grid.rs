//! The skin of the reference face: a grid of 37 × 39 vertices, slit at the eyes and the mouth, with rims turned inwards.
//!
//! Column 19 is the midline. Inside a slit a column owns two vertices, one of either side;
//! quads above use the upper one, quads below the lower one.
//! Vertices follow row by row, then the lower sides of the slits, then the rims.

use nalgebra::Vector3;

use super::{
    depth::depth_cm,
    lids,
    pchip::Pchip,
    tables::{
        EYE_COLUMNS, FEATURE_ROWS, FeatureRow, KEY_COLUMNS, LOWER_LID_MARGIN, LOWER_LIP_MARGIN,
        MOUTH_CORNER_COLUMN, N_HALF_COLUMNS, Opening,
    },
};

/// Column of the midline.
const MIDLINE: usize = N_HALF_COLUMNS - 1;
const N_COLUMNS: usize = 2 * MIDLINE + 1;
/// Grid row of the eye slit.
const EYE_ROW: usize = 12;
/// Grid row of the mouth slit.
const MOUTH_ROW: usize = 26;
/// From the upper lid's margin to its rim; the lower lid mirrors it in y.
const LID_RIM_CM: Vector3<f64> = Vector3::new(0.0, -0.02, -0.22);
/// From the upper lip's margin to its rim; the lower lip mirrors it in y.
const LIP_RIM_CM: Vector3<f64> = Vector3::new(0.0, 0.05, -0.55);

type HalfRow = [f64; N_HALF_COLUMNS];

/// A vertex of the neutral skin and what part of the face it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct SkinVertex {
    /// Where it lies, centimeters.
    pub(super) place: Vector3<f64>,
    /// On the inner rim of a lid or a lip.
    pub(super) rim: bool,
    /// The grid row; half a row less on the upper side of a slit, half a row more on the lower side.
    row: f64,
}

impl SkinVertex {
    /// On the lower side of the mouth slit, or below it.
    pub(super) fn below_mouth(&self) -> bool {
        self.row > MOUTH_ROW as f64 + 0.25
    }

    /// On the lower side of the eye slit, or below it.
    pub(super) fn below_eye(&self) -> bool {
        self.row > EYE_ROW as f64 + 0.25
    }

    /// On the upper side of the eye slit, or above it.
    pub(super) fn above_eye(&self) -> bool {
        self.row < EYE_ROW as f64 - 0.25
    }

    /// Among the first rows below the eye slit.
    pub(super) fn lower_lid(&self) -> bool {
        self.below_eye() && self.row < EYE_ROW as f64 + 3.0
    }
}

/// The neutral skin.
pub(super) struct Skin {
    pub(super) vertices: Vec<SkinVertex>,
    /// Counter-clockwise seen from outside.
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Builds the neutral skin: 1,536 vertices, 2,860 triangles.
pub(super) fn skin() -> Skin {
    let rows = grid_rows();
    let mut skin = Skin {
        vertices: Vec::new(),
        triangles: Vec::new(),
    };
    let above: Vec<Columns> = rows
        .iter()
        .enumerate()
        .map(|(at, row)| skin.add_row(at, row))
        .collect();
    let below = skin.add_lower_sides(&rows, &above);
    for vertex in &mut skin.vertices {
        vertex.place.z = depth_cm(vertex.place.x, vertex.place.y);
        vertex.place.z = lids::resting_depth_cm(&vertex.place);
    }
    for at in 0..rows.len() - 1 {
        skin.add_band(&below[at], &above[at + 1]);
    }
    skin.add_rims(&above, &below);
    skin
}

/// One row of the grid, left half.
#[derive(Clone)]
struct GridRow {
    x: HalfRow,
    y: HalfRow,
    /// Of a slit's lower side: y where the slit parts the skin.
    lower_y: Option<HalfRow>,
    opening: Option<Opening>,
}

/// Vertex indices along a row, from the subject's right to left.
type Columns = [u32; N_COLUMNS];

/// The half-column and the sign of x of a column.
fn half_column(column: usize) -> (usize, f64) {
    (
        column.abs_diff(MIDLINE),
        if column >= MIDLINE { 1.0 } else { -1.0 },
    )
}

fn grid_rows() -> Vec<GridRow> {
    let features: Vec<GridRow> = FEATURE_ROWS.iter().map(feature_row).collect();
    let mut rows = Vec::new();
    for (pair, feature) in features.windows(2).zip(&FEATURE_ROWS) {
        rows.push(pair[0].clone());
        rows.extend((1..feature.n_segments).map(|segment| {
            between(
                &pair[0],
                &pair[1],
                segment as f64 / feature.n_segments as f64,
            )
        }));
    }
    rows.extend(features.into_iter().next_back());
    rows
}

fn feature_row(feature: &FeatureRow) -> GridRow {
    let (x_curve, y_curve) = (
        Pchip::new(&KEY_COLUMNS, &feature.x_cm),
        Pchip::new(&KEY_COLUMNS, &feature.y_cm),
    );
    let x: HalfRow = std::array::from_fn(|column| x_curve.at(column as f64));
    let y: HalfRow = std::array::from_fn(|column| y_curve.at(column as f64));
    GridRow {
        x,
        y,
        lower_y: feature.opening.map(|opening| lower_side(opening, &x, &y)),
        opening: feature.opening,
    }
}

fn lower_side(opening: Opening, x: &HalfRow, y: &HalfRow) -> HalfRow {
    let margin = match opening {
        Opening::Eye => Pchip::new(&LOWER_LID_MARGIN.0, &LOWER_LID_MARGIN.1),
        Opening::Mouth => Pchip::new(&LOWER_LIP_MARGIN.0, &LOWER_LIP_MARGIN.1),
    };
    std::array::from_fn(|column| {
        if opening.parts(column) {
            margin.at(x[column])
        } else {
            y[column]
        }
    })
}

/// A plain row between two feature rows; below a slit it starts from the slit's lower side.
fn between(from: &GridRow, to: &GridRow, fraction: f64) -> GridRow {
    let mix = |a: &HalfRow, b: &HalfRow| -> HalfRow {
        std::array::from_fn(|column| (1.0 - fraction) * a[column] + fraction * b[column])
    };
    GridRow {
        x: mix(&from.x, &to.x),
        y: mix(from.lower_y.as_ref().unwrap_or(&from.y), &to.y),
        lower_y: None,
        opening: None,
    }
}

impl Skin {
    fn add(&mut self, vertex: SkinVertex) -> u32 {
        self.vertices.push(vertex);
        u32::try_from(self.vertices.len() - 1).expect("invariant: the face has 1,536 vertices")
    }

    fn add_row(&mut self, at: usize, row: &GridRow) -> Columns {
        std::array::from_fn(|column| {
            let (half, sign) = half_column(column);
            let parted = row.opening.is_some_and(|opening| opening.parts(half));
            self.add(SkinVertex {
                place: Vector3::new(sign * row.x[half], row.y[half], 0.0),
                rim: false,
                row: at as f64 - if parted { 0.5 } else { 0.0 },
            })
        })
    }

    /// The rows as seen from below: the same vertices, but the lower ones inside the slits.
    fn add_lower_sides(&mut self, rows: &[GridRow], above: &[Columns]) -> Vec<Columns> {
        let mut below = above.to_vec();
        for (column, (half, sign)) in (0..N_COLUMNS).map(half_column).enumerate() {
            for (at, row) in rows.iter().enumerate() {
                let (Some(opening), Some(lower_y)) = (row.opening, row.lower_y) else {
                    continue;
                };
                if opening.parts(half) {
                    below[at][column] = self.add(SkinVertex {
                        place: Vector3::new(sign * row.x[half], lower_y[half], 0.0),
                        rim: false,
                        row: at as f64 + 0.5,
                    });
                }
            }
        }
        below
    }

    /// The quads between two rows; their diagonals flip at the midline, so that the halves mirror each other.
    fn add_band(&mut self, upper: &Columns, lower: &Columns) {
        for column in 0..N_COLUMNS - 1 {
            let (a, b) = (upper[column], upper[column + 1]);
            let (d, e) = (lower[column], lower[column + 1]);
            if column < MIDLINE {
                self.triangles.extend([[a, d, e], [a, e, b]]);
            } else {
                self.triangles.extend([[a, d, b], [b, d, e]]);
            }
        }
    }

    fn add_rims(&mut self, above: &[Columns], below: &[Columns]) {
        let (inner, outer) = EYE_COLUMNS;
        let eyes = [
            MIDLINE + inner..=MIDLINE + outer,
            MIDLINE - outer..=MIDLINE - inner,
        ];
        for eye in eyes {
            self.add_rim(&above[EYE_ROW][eye.clone()], LID_RIM_CM, Side::Upper);
            self.add_rim(&below[EYE_ROW][eye], LID_RIM_CM, Side::Lower);
        }
        let mouth = MIDLINE - MOUTH_CORNER_COLUMN..=MIDLINE + MOUTH_CORNER_COLUMN;
        self.add_rim(&above[MOUTH_ROW][mouth.clone()], LIP_RIM_CM, Side::Upper);
        self.add_rim(&below[MOUTH_ROW][mouth], LIP_RIM_CM, Side::Lower);
    }

    /// A strip that turns inwards from the `edge` of a slit; the two ends are the slit's corners.
    fn add_rim(&mut self, edge: &[u32], upper_rim_cm: Vector3<f64>, side: Side) {
        let inwards = match side {
            Side::Upper => upper_rim_cm,
            Side::Lower => upper_rim_cm.component_mul(&Vector3::new(1.0, -1.0, 1.0)),
        };
        let last = edge.len() - 1;
        let inner: Vec<u32> = (edge.iter().enumerate())
            .map(|(at, &outer)| {
                if at == 0 || at == last {
                    return outer;
                }
                let parent = self.vertices[outer as usize];
                let place = parent.place + inwards;
                self.add(SkinVertex {
                    place,
                    rim: true,
                    ..parent
                })
            })
            .collect();
        for (p, q) in edge.windows(2).zip(inner.windows(2)) {
            let strip = match side {
                Side::Upper => [[p[0], q[1], q[0]], [p[0], p[1], q[1]]],
                Side::Lower => [[p[0], q[0], q[1]], [p[0], q[1], p[1]]],
            };
            let flat = |[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
            self.triangles.extend(strip.iter().filter(|it| !flat(it)));
        }
    }
}

/// A side of a slit.
#[derive(Clone, Copy)]
enum Side {
    Upper,
    Lower,
}
