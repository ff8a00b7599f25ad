//! The terms of the objective and its bounds: what a request makes of them, and whether the actor has what they name.

use frontalis_analysis::{
    face::muscle::MuscleSet,
    marker_analysis::objective::{LARGEST_BOUND, MuscleBounds, Objective, ObjectiveError},
};
use frontalis_proto::v1;

use super::{Change, FieldError, SessionSettings, narrow};

/// What is wrong with the objective, on the wire.
const REASON: &str = "SOLVER_OPTIONS";

/// `base` with what `asked` changes.
///
/// `plain` comes first: true switches every term off, false brings the defaults back when every term was off. The terms
/// that are asked for follow; beside `plain` there may be none.
pub(super) fn apply(
    change: &Change<'_>,
    asked: &v1::SessionSettings,
    base: &Objective,
) -> Result<Objective, FieldError> {
    let plain = change.wanted("plain", asked.plain, false);
    let default = match plain {
        Some(true) => Objective::plain(),
        Some(false) | None => Objective::default(),
    };
    let mut next = match plain {
        Some(true) => with_terms_of(&default, base),
        Some(false) if base.is_plain() => with_terms_of(&default, base),
        Some(false) | None => base.clone(),
    };
    let put_strength = |field, asked: Option<f32>, place: &mut f64, default| {
        change.put(field, asked.map(f64::from), place, default);
    };
    put_strength(
        "smoothing",
        asked.smoothing,
        &mut next.smoothing,
        default.smoothing,
    );
    put_strength(
        "sparsity",
        asked.sparsity,
        &mut next.sparsity,
        default.sparsity,
    );
    put_strength(
        "symmetry",
        asked.symmetry,
        &mut next.symmetry,
        default.symmetry,
    );
    change.put("robust", asked.robust, &mut next.robust, default.robust);
    change.put("bounds", bounds(asked), &mut next.bounds, Vec::new());
    change.put(
        "exclusive_pairs",
        pairs(asked),
        &mut next.exclusive_pairs,
        Vec::new(),
    );
    if plain == Some(true) && !next.is_plain() {
        let detail = "switches every term off, and a term is asked for beside it";
        return Err(FieldError::unusable("plain", REASON, detail));
    }
    Ok(next)
}

/// Bounds and pairs are no terms: they stay.
fn with_terms_of(terms: &Objective, base: &Objective) -> Objective {
    Objective {
        bounds: base.bounds.clone(),
        exclusive_pairs: base.exclusive_pairs.clone(),
        ..terms.clone()
    }
}

/// The list that was sent; an empty one was not.
fn bounds(asked: &v1::SessionSettings) -> Option<Vec<MuscleBounds>> {
    let own = |it: &v1::ControlBounds| MuscleBounds {
        muscle: it.control.clone(),
        lower: it.lower.into(),
        upper: it.upper.into(),
    };
    let sent = &asked.bounds;
    (!sent.is_empty()).then(|| sent.iter().map(own).collect())
}

fn pairs(asked: &v1::SessionSettings) -> Option<Vec<[String; 2]>> {
    let own = |it: &v1::ControlPair| [it.first.clone(), it.second.clone()];
    let sent = &asked.exclusive_pairs;
    (!sent.is_empty()).then(|| sent.iter().map(own).collect())
}

pub(super) fn bounds_to_wire(objective: &Objective) -> Vec<v1::ControlBounds> {
    let wire = |it: &MuscleBounds| v1::ControlBounds {
        control: it.muscle.clone(),
        lower: narrow(it.lower),
        upper: narrow(it.upper),
    };
    objective.bounds.iter().map(wire).collect()
}

pub(super) fn pairs_to_wire(objective: &Objective) -> Vec<v1::ControlPair> {
    let wire = |[first, second]: &[String; 2]| v1::ControlPair {
        first: first.clone(),
        second: second.clone(),
    };
    objective.exclusive_pairs.iter().map(wire).collect()
}

/// Whether every number of the objective is in its range, and the actor has every muscle that it names.
///
/// # Errors
///
/// `SOLVER_OPTIONS` for the first field that is wrong.
pub fn check_objective(settings: &SessionSettings, muscles: &MuscleSet) -> Result<(), FieldError> {
    let objective = &settings.marker.objective;
    let refused = |error: ObjectiveError| {
        let detail = detail(&error, objective);
        FieldError::unusable(field(&error), REASON, detail).inside("settings")
    };
    objective.check(muscles).map_err(refused)
}

fn field(error: &ObjectiveError) -> &'static str {
    match error {
        ObjectiveError::Strength { field, .. } | ObjectiveError::UnknownMuscle { field, .. } => {
            field
        }
        ObjectiveError::Bounds { .. } | ObjectiveError::BoundsTwice { .. } => "bounds",
        ObjectiveError::Pair { .. } | ObjectiveError::PairCount { .. } => "exclusive_pairs",
    }
}

/// What is wrong, with numbers as they were sent. A name that no muscle has is the client's text, and not repeated.
fn detail(error: &ObjectiveError, objective: &Objective) -> String {
    match error {
        ObjectiveError::Strength { found, .. } => {
            format!("{} is not within 0..=1", narrow(*found))
        }
        ObjectiveError::Bounds {
            muscle,
            lower,
            upper,
        } => format!(
            "those of {muscle} are {} to {}, expected 0 <= lower <= upper <= {LARGEST_BOUND}",
            narrow(*lower),
            narrow(*upper)
        ),
        ObjectiveError::UnknownMuscle {
            muscle, muscle_set, ..
        } => format!(
            "entry {} names no muscle of {muscle_set}",
            place(muscle, objective)
        ),
        ObjectiveError::BoundsTwice { .. }
        | ObjectiveError::Pair { .. }
        | ObjectiveError::PairCount { .. } => error.to_string(),
    }
}

/// Place of the first entry with this name, from 1, in the bounds or else in the pairs: bounds are checked first.
fn place(muscle: &str, objective: &Objective) -> usize {
    let mut bounds = objective.bounds.iter();
    let mut pairs = objective.exclusive_pairs.iter();
    let idx = bounds
        .position(|it| it.muscle == muscle)
        .or_else(|| pairs.position(|it| it.iter().any(|it| it == muscle)));
    idx.map_or(1, |it| it + 1)
}
