//! Coordinate alignment of a performance to the actor's neutral face (Choe & Ko 2001, section 4.1.1).
//!
//! Finds s, R, t of ᴹp = s R ᴾp + t from pairs of real and virtual markers, in closed form; projects the aligned markers
//! onto the surface along its normal, takes the feet as the new virtual markers, and repeats until they stand still.
//! The feet are kept as triangle and barycentric weights.
//!
//! Projection mends the artist's hand-marking, but on a smooth surface it also lets the noise of the neutral frames slide
//! the virtual markers about. Both are known: the noise from the spread of the frames, the hand-marking from how badly the
//! hand-marked points fit at first. What is projected is the mean of the aligned and the hand-marked point, weighted by
//! the two variances: all of the paper's step where hand-marking is the larger error, none where it is exact.

use crate::{
    face::{actor::Actor, marker::VirtualMarker, region::FaceRegion},
    marker_analysis::neutral::Neutral,
    numeric::similarity_fit::{Scale, fit},
    space::{LengthUnit, ModelPoint, PerformancePoint, Similarity},
};

/// Rounds of fit and projection; sliding along a smooth surface is slow, so it is cut off.
const ROUNDS: u32 = 30;

/// The virtual markers stand still when none moves further than this in a round, centimeters.
const STILL_CM: f64 = 1e-4;

/// How far a marker may be projected from where the artist put it, centimeters along the surface.
const PROJECTION_RADIUS_CM: f64 = 1.5;

/// Degrees of freedom of a similarity.
const SIMILARITY_FREEDOM: f64 = 7.0;

/// Extent of a face's markers, centimeters in any unit that a capture may mean.
const FACE_EXTENT_CM: std::ops::RangeInclusive<f64> = 5.0..=60.0;

/// Own markers of each region that the neutral frames must show.
const MARKERS_PER_REGION: usize = 4;

/// A mirror image's smallest singular value is this share of the second, or more; a flat set says nothing.
const MIRRORED: f64 = -0.02;

/// Where the capture system's axes lie on the actor, and where each marker sits on the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// The similarity from performance to model space.
    pub model_from_performance: Similarity,
    /// One entry a marker of the actor: its place on the mesh; `None` when it was never seen in the neutral frames.
    pub bindings: Vec<Option<VirtualMarker>>,
    /// Root mean square distance of the aligned markers from their virtual markers, centimeters.
    pub rms_residual_cm: f64,
    /// Rounds of similarity and projection.
    pub iterations: u32,
}

/// Why the neutral frames could not be aligned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AlignmentError {
    /// The face's extent is not that of a face in the declared unit.
    #[error(
        "the neutral markers span {extent_m:.4} m, a face spans 0.05 to 0.60 m: the coordinates are {}",
        likely.map_or("not in millimeters, centimeters or meters".to_owned(), |it| format!("probably in {}", it.symbol()))
    )]
    UnitsSuspect {
        /// Measured extent, in meters as declared.
        extent_m: f64,
        /// The unit in which the extent would be a face's.
        likely: Option<LengthUnit>,
    },
    /// The markers fit the face only mirrored.
    #[error(
        "the neutral markers are a mirror image of the face: left and right, or an axis, are swapped"
    )]
    Mirrored,
    /// Too few markers of a region were seen in the neutral frames.
    #[error(
        "the neutral frames show {found} markers of the {} region, {MARKERS_PER_REGION} are needed; never seen: {}",
        region.name(),
        missing.join(", ")
    )]
    NeutralIncomplete {
        /// The region.
        region: FaceRegion,
        /// Its own markers that were seen.
        found: usize,
        /// Names of the markers, of any region, never seen.
        missing: Vec<String>,
    },
    /// The markers do not span space: identical or on a line.
    #[error("the neutral markers are identical or lie on a line")]
    Degenerate,
}

impl Alignment {
    /// Aligns the mean neutral markers, one entry a marker of the actor, to the actor's face.
    ///
    /// `unit` is the unit that the capture declared; it only serves the error that names the likely one.
    ///
    /// # Errors
    ///
    /// When too few markers were seen, they do not span a face, or span a mirrored one.
    pub fn find(
        actor: &Actor,
        neutral: &Neutral,
        unit: LengthUnit,
    ) -> Result<Self, AlignmentError> {
        check_complete(actor, &neutral.positions)?;
        check_extent(&neutral.positions, unit)?;
        let mut search = Search::start(actor, &neutral.positions);
        let mut similarity = search.fit()?;
        let trust = search.trust_in_projection(&similarity, neutral.noise_cm);
        let mut iterations = 1;
        while iterations < ROUNDS {
            let moved_cm = search.project(&similarity, trust);
            similarity = search.fit()?;
            iterations += 1;
            if moved_cm < STILL_CM {
                break;
            }
        }
        Ok(Self {
            rms_residual_cm: search.rms_residual(&similarity),
            model_from_performance: similarity,
            bindings: search.bindings,
            iterations,
        })
    }

    /// Markers that took part.
    pub fn n_markers(&self) -> usize {
        self.bindings.iter().flatten().count()
    }

    /// The same alignment on another revision of the actor: where the mesh is another, each marker moves to the closest
    /// point of it.
    #[must_use]
    pub fn carried_over(&self, from: &Actor, to: &Actor) -> Self {
        if from.mesh().triangles == to.mesh().triangles {
            return self.clone();
        }
        let carry = |binding: VirtualMarker| {
            let position = binding.position(from.mesh());
            to.mesh()
                .closest_point(position, |_| true)
                .map(|it| it.place)
        };
        let bindings = self.bindings.iter().map(|it| it.and_then(carry)).collect();
        Self {
            bindings,
            ..self.clone()
        }
    }
}

fn check_complete(
    actor: &Actor,
    neutral: &[Option<PerformancePoint>],
) -> Result<(), AlignmentError> {
    let seen = || actor.markers().iter().zip(neutral);
    for region in FaceRegion::ALL {
        let own = || seen().filter(|(it, _)| it.region == region && !it.head_fixed);
        let found = own().filter(|(_, position)| position.is_some()).count();
        let moved = |it: &crate::face::muscle::Muscle| it.region == region;
        if found < MARKERS_PER_REGION && actor.muscle_set().muscles().iter().any(moved) {
            let missing = seen()
                .filter(|(_, position)| position.is_none())
                .map(|(it, _)| it.name.clone())
                .collect();
            return Err(AlignmentError::NeutralIncomplete {
                region,
                found,
                missing,
            });
        }
    }
    Ok(())
}

fn check_extent(
    neutral: &[Option<PerformancePoint>],
    unit: LengthUnit,
) -> Result<(), AlignmentError> {
    let seen = || neutral.iter().flatten();
    let extent_cm = seen()
        .flat_map(|a| seen().map(move |b| (a.0 - b.0).norm()))
        .fold(0.0, f64::max);
    if FACE_EXTENT_CM.contains(&extent_cm) {
        return Ok(());
    }
    if extent_cm <= 0.0 {
        return Err(AlignmentError::Degenerate);
    }
    let as_declared = extent_cm / unit.centimeters();
    let likely = [
        LengthUnit::Millimeter,
        LengthUnit::Centimeter,
        LengthUnit::Meter,
    ]
    .into_iter()
    .find(|it| FACE_EXTENT_CM.contains(&(as_declared * it.centimeters())));
    Err(AlignmentError::UnitsSuspect {
        extent_m: extent_cm / 100.0,
        likely,
    })
}

/// Real markers and where their virtual markers presently are.
struct Search<'a> {
    actor: &'a Actor,
    neutral: &'a [Option<PerformancePoint>],
    bindings: Vec<Option<VirtualMarker>>,
    /// The triangles that each marker may slide over.
    reachable: Vec<Vec<usize>>,
}

impl<'a> Search<'a> {
    /// Every marker that was seen starts where the artist put it.
    fn start(actor: &'a Actor, neutral: &'a [Option<PerformancePoint>]) -> Self {
        let hand_marked = actor.virtual_markers().iter().zip(neutral);
        let bindings: Vec<_> = hand_marked
            .map(|(hand_marked, seen)| seen.map(|_| *hand_marked))
            .collect();
        let around = |it: &Option<VirtualMarker>| {
            it.map_or(Vec::new(), |it| {
                actor.mesh().neighborhood(it.triangle, PROJECTION_RADIUS_CM)
            })
        };
        Self {
            actor,
            neutral,
            reachable: bindings.iter().map(around).collect(),
            bindings,
        }
    }

    /// Pairs of real and virtual marker.
    fn pairs(&self) -> impl Iterator<Item = (PerformancePoint, ModelPoint)> + Clone {
        let mesh = self.actor.mesh();
        let markers = self.neutral.iter().zip(&self.bindings);
        markers.filter_map(move |(real, binding)| Some(((*real)?, (*binding)?.position(mesh))))
    }

    /// The closed-form similarity between the real markers and their present virtual markers.
    fn fit(&self) -> Result<Similarity, AlignmentError> {
        let pairs = self
            .pairs()
            .map(|(real, virtual_marker)| (1.0, real.0, virtual_marker.0));
        let found = fit(pairs, Scale::Free).ok_or(AlignmentError::Degenerate)?;
        if found.handedness < MIRRORED {
            return Err(AlignmentError::Mirrored);
        }
        Ok(Similarity {
            scale: found.scale,
            rotation: found.rotation,
            translation_cm: found.translation,
        })
    }

    /// Root mean square distance of the aligned markers from their virtual markers, centimeters.
    fn rms_residual(&self, similarity: &Similarity) -> f64 {
        let squares = self
            .pairs()
            .map(|(real, place)| (similarity.to_model(real).0 - place.0).norm_squared());
        let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), it| (sum + it, count + 1.0));
        (sum / f64::max(count, 1.0)).sqrt()
    }

    /// The share of the hand-marking's variance in that of hand-marking and noise together.
    ///
    /// The residual of the first fit holds both, over 3n less the similarity's seven degrees of freedom.
    fn trust_in_projection(&self, first: &Similarity, noise_cm: f64) -> f64 {
        let n = self.pairs().count() as f64;
        let freedom = (3.0 * n - SIMILARITY_FREEDOM).max(1.0);
        let both = self.rms_residual(first).powi(2) * n / freedom;
        let noise = noise_cm * noise_cm;
        if both > noise {
            (both - noise) / both
        } else {
            0.0
        }
    }

    /// Moves every virtual marker to the foot of its real one on the surface, as far as `trust` goes; returns the
    /// largest move, centimeters.
    fn project(&mut self, similarity: &Similarity, trust: f64) -> f64 {
        let mesh = self.actor.mesh();
        let mut largest_cm = 0.0_f64;
        let hand_marked = self.actor.virtual_markers().iter();
        let markers = self.neutral.iter().zip(&mut self.bindings);
        for (((real, binding), hand_marked), triangles) in
            markers.zip(hand_marked).zip(&self.reachable)
        {
            let (Some(real), Some(binding)) = (real, binding) else {
                continue;
            };
            let start = hand_marked.position(mesh).0;
            let target = start + trust * (similarity.to_model(*real).0 - start);
            let among = triangles.iter().copied();
            if let Some(foot) = mesh.closest_point_among(ModelPoint(target), among) {
                let before = binding.position(mesh);
                largest_cm = largest_cm.max((foot.position.0 - before.0).norm());
                *binding = foot.place;
            }
        }
        largest_cm
    }
}
