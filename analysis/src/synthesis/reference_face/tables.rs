//! Every number of the reference face: feature rows, depth curves, bumps, eyes and openings.
//!
//! Centimeters; +x the subject's left, +y up, y = 0 at the eye line. Only the left half is given, the face is symmetric.

/// Half-columns of the grid, midline to side: 0..=19.
pub(super) const N_HALF_COLUMNS: usize = 20;

/// Half-columns at which a feature row gives x and y; the columns between are interpolated.
pub(super) const KEY_COLUMNS: [f64; 7] = [0.0, 3.0, 5.0, 9.0, 13.0, 16.0, 19.0];

/// Half-columns of the inner and the outer canthus; those strictly between have two lids.
pub(super) const EYE_COLUMNS: (usize, usize) = (5, 13);

/// Half-column of the mouth corner; those before it have two lips.
pub(super) const MOUTH_CORNER_COLUMN: usize = 9;

/// A slit of the skin: along it a column owns one vertex for each side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Opening {
    /// Between the eyelids.
    Eye,
    /// Between the lips.
    Mouth,
}

impl Opening {
    /// Whether the slit parts the skin at a half-column.
    pub(super) fn parts(self, half_column: usize) -> bool {
        match self {
            Self::Eye => EYE_COLUMNS.0 < half_column && half_column < EYE_COLUMNS.1,
            Self::Mouth => half_column < MOUTH_CORNER_COLUMN,
        }
    }
}

/// A line across the face that follows a feature.
#[derive(Clone, Copy)]
pub(super) struct FeatureRow {
    /// How many grid rows lie between this feature, included, and the next.
    pub(super) n_segments: usize,
    /// x at the key columns.
    pub(super) x_cm: [f64; 7],
    /// y at the key columns.
    pub(super) y_cm: [f64; 7],
    /// The slit along this row.
    pub(super) opening: Option<Opening>,
}

const fn row(n_segments: usize, x_cm: [f64; 7], y_cm: [f64; 7]) -> FeatureRow {
    FeatureRow {
        n_segments,
        x_cm,
        y_cm,
        opening: None,
    }
}

const fn slit(opening: Opening, row: FeatureRow) -> FeatureRow {
    FeatureRow {
        opening: Some(opening),
        ..row
    }
}

/// The feature rows from the top of the forehead to below the chin.
#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "a height that happens to be near 2π")]
pub(super) const FEATURE_ROWS: [FeatureRow; 17] = [
    // Hairline.
    row(3, [0.0, 0.9, 1.6, 3.2, 4.75, 5.75, 6.45], [7.9, 7.87, 7.76, 7.2, 6.15, 5.05, 3.95]),
    // Forehead.
    row(3, [0.0, 0.9, 1.6, 3.2, 4.85, 6.0, 6.85], [5.2, 5.18, 5.12, 4.95, 4.45, 3.75, 2.95]),
    // Upper edge of the brows.
    row(2, [0.0, 0.85, 1.55, 3.2, 4.85, 6.1, 6.95], [2.35, 2.3, 2.38, 2.8, 2.35, 1.9, 1.8]),
    // Lower edge of the brows.
    row(2, [0.0, 0.85, 1.55, 3.15, 4.8, 6.1, 7.0], [1.45, 1.38, 1.48, 1.98, 1.6, 1.25, 1.15]),
    // Crease of the upper lid.
    row(2, [0.0, 0.8, 1.5, 3.1, 4.75, 6.1, 7.05], [0.55, 0.45, 0.35, 1.0, 0.55, 0.45, 0.45]),
    // Margin of the upper lid.
    slit(Opening::Eye, row(2, [0.0, 0.8, 1.62, 3.1, 4.62, 6.05, 7.05], [-0.15, -0.12, -0.12, 0.52, 0.1, 0.0, 0.0])),
    // Below the lower lid.
    row(2, [0.0, 0.8, 1.5, 3.05, 4.7, 6.0, 7.05], [-0.85, -0.75, -0.6, -1.05, -0.55, -0.65, -0.65]),
    // Cheek bone.
    row(2, [0.0, 0.75, 1.4, 2.9, 4.55, 5.9, 6.98], [-2.05, -2.05, -2.0, -2.2, -2.0, -1.95, -1.9]),
    // Top of the nose wings.
    row(4, [0.0, 0.65, 1.35, 2.7, 4.4, 5.75, 6.85], [-3.45, -3.4, -3.35, -3.5, -3.4, -3.3, -3.2]),
    // Base of the nose.
    row(2, [0.0, 0.5, 1.55, 2.65, 4.25, 5.6, 6.65], [-4.95, -4.92, -4.75, -4.95, -4.9, -4.75, -4.6]),
    // Upper edge of the lips.
    row(2, [0.0, 0.48, 0.98, 2.5, 4.1, 5.4, 6.45], [-6.28, -6.17, -6.32, -6.92, -6.25, -6.05, -5.8]),
    // Lower edge of the upper lip.
    slit(Opening::Mouth, row(2, [0.0, 0.55, 1.05, 2.52, 4.05, 5.3, 6.3], [-6.92, -6.95, -6.95, -7.02, -7.0, -6.85, -6.6])),
    // Lower edge of the lips.
    row(2, [0.0, 0.5, 1.0, 2.46, 3.95, 5.1, 6.05], [-7.92, -7.88, -7.75, -7.12, -7.75, -7.65, -7.4]),
    // Mentolabial fold.
    row(2, [0.0, 0.5, 1.0, 2.3, 3.75, 4.85, 5.75], [-8.6, -8.6, -8.55, -8.3, -8.55, -8.45, -8.2]),
    // Chin.
    row(2, [0.0, 0.5, 1.0, 2.15, 3.45, 4.5, 5.4], [-9.9, -9.88, -9.8, -9.6, -9.5, -9.15, -8.65]),
    // Lowest point of the chin.
    row(2, [0.0, 0.45, 0.9, 1.95, 3.15, 4.25, 5.22], [-11.05, -11.02, -10.98, -10.75, -10.35, -9.8, -9.02]),
    // Below the chin.
    row(0, [0.0, 0.42, 0.82, 1.75, 2.9, 4.0, 5.05], [-11.32, -11.3, -11.26, -11.05, -10.65, -10.1, -9.25]),
];

/// Upper lid: y over |x| between the canthi.
pub(super) const UPPER_LID_MARGIN: ([f64; 5], [f64; 5]) =
    ([1.62, 2.3, 3.1, 3.9, 4.62], [-0.12, 0.3, 0.52, 0.42, 0.1]);

/// Lower lid: y over |x| between the canthi.
pub(super) const LOWER_LID_MARGIN: ([f64; 5], [f64; 5]) = (
    [1.62, 2.3, 3.1, 3.9, 4.62],
    [-0.12, -0.42, -0.5, -0.32, 0.1],
);

/// Upper edge of the lower lip: y over |x|.
pub(super) const LOWER_LIP_MARGIN: ([f64; 5], [f64; 5]) = (
    [0.0, 0.55, 1.05, 2.0, 2.52],
    [-7.0, -7.01, -7.0, -7.0, -7.02],
);

/// Half width of the head over y.
pub(super) const HALF_WIDTH: ([f64; 14], [f64; 14]) = (
    [
        -12.0, -11.2, -10.4, -9.5, -8.3, -7.0, -5.0, -3.0, -1.0, 1.0, 3.0, 5.0, 7.0, 8.5,
    ],
    [
        4.6, 5.0, 5.5, 5.85, 6.2, 6.55, 6.95, 7.2, 7.35, 7.4, 7.3, 7.05, 6.6, 6.2,
    ],
);

/// Depth z of the center line over y, without nose and lips.
pub(super) const CENTER_DEPTH: ([f64; 23], [f64; 23]) = (
    [
        -12.0, -11.4, -11.05, -10.5, -9.9, -9.2, -8.6, -7.9, -7.0, -6.2, -5.0, -3.5, -2.0, -0.8,
        0.0, 0.7, 1.6, 2.3, 3.5, 5.2, 6.6, 7.9, 8.5,
    ],
    [
        5.6, 7.1, 8.35, 9.35, 9.7, 9.5, 9.2, 9.35, 9.55, 9.5, 9.3, 9.05, 8.85, 8.72, 8.72, 8.9,
        9.32, 9.36, 9.18, 8.8, 8.15, 7.0, 6.3,
    ],
);

/// How far the nose stands out over y.
pub(super) const NOSE_HEIGHT: ([f64; 13], [f64; 13]) = (
    [
        -5.6, -5.1, -4.95, -4.7, -4.35, -4.0, -3.4, -2.4, -1.2, -0.3, 0.3, 1.0, 1.6,
    ],
    [
        0.0, 0.1, 0.45, 1.35, 2.15, 2.38, 2.15, 1.52, 0.88, 0.5, 0.36, 0.16, 0.0,
    ],
);

/// Width of the nose over y.
pub(super) const NOSE_WIDTH: ([f64; 8], [f64; 8]) = (
    [-5.6, -4.6, -4.0, -3.2, -2.0, -0.8, 0.5, 1.6],
    [0.85, 1.02, 1.02, 0.9, 0.76, 0.64, 0.74, 1.0],
);

/// Range of y within which there is a nose.
pub(super) const NOSE_SPAN: (f64, f64) = (-5.6, 1.6);

/// A Gaussian hill, or with a negative height a hollow, on both halves of the face; centimeters.
pub(super) struct Bump {
    /// Center, |x| and y.
    pub(super) center: (f64, f64),
    /// Standard deviations in x and y.
    pub(super) spread: (f64, f64),
    /// Change of depth at the center.
    pub(super) height: f64,
}

const fn bump(x_cm: f64, y_cm: f64, spread_x_cm: f64, spread_y_cm: f64, height_cm: f64) -> Bump {
    Bump {
        center: (x_cm, y_cm),
        spread: (spread_x_cm, spread_y_cm),
        height: height_cm,
    }
}

/// What makes the smooth head a face.
#[rustfmt::skip]
pub(super) const BUMPS: [Bump; 19] = [
    bump(1.42, -4.3, 0.36, 0.42, 0.55), // Nose wing.
    bump(3.1, 0.05, 1.5, 0.9, -1.0), // Eye socket.
    bump(1.45, 0.1, 0.55, 0.6, -0.42), // Inner canthus hollow.
    bump(3.1, 0.0, 0.95, 0.62, 0.62), // The lids follow the eyeball.
    bump(3.2, 2.05, 1.7, 0.5, 0.34), // Brow ridge.
    bump(0.0, 1.75, 0.9, 0.5, 0.1), // Glabella.
    bump(4.45, -2.25, 1.3, 1.1, 0.5), // Cheek bone.
    bump(3.0, -3.6, 1.0, 1.1, 0.28), // Apple of the cheek.
    bump(4.35, -5.9, 1.3, 1.6, -0.42), // Hollow below the cheek bone.
    bump(2.05, -5.35, 0.4, 0.75, -0.2), // Nasolabial groove.
    bump(0.0, -5.7, 0.24, 0.5, -0.13), // Philtrum.
    bump(0.48, -6.45, 0.55, 0.3, 0.34), // Upper lip, two lobes.
    bump(0.0, -6.6, 1.2, 0.32, 0.32), // Upper lip, middle.
    bump(0.55, -7.4, 0.85, 0.36, 0.46), // Lower lip.
    bump(0.0, -7.45, 1.3, 0.35, 0.24), // Lower lip, middle.
    bump(2.55, -7.03, 0.42, 0.42, -0.34), // Mouth corner.
    bump(0.0, -8.55, 1.5, 0.38, -0.26), // Mentolabial fold.
    bump(0.35, -9.75, 0.95, 0.75, 0.34), // Chin.
    bump(6.6, 3.0, 1.3, 2.0, -0.25), // Temple.
];

/// Center of the left eyeball.
pub(super) const EYE_CENTER_CM: (f64, f64, f64) = (3.12, 0.0, 6.42);

/// Radius on which the lids rest, without the lids' own thickness.
pub(super) const EYE_RADIUS_CM: f64 = 1.22;
