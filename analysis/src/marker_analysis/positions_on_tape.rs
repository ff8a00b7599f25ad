//! The markers of one instant as numbers on a tape.

use nalgebra::Point3;

use crate::{
    numeric::tape::{Tape, TapeError},
    space::PerformancePoint,
};

/// Names which markers were seen, and where.
pub(crate) fn last(
    positions: &mut [Option<PerformancePoint>],
    tape: &mut Tape,
) -> Result<(), TapeError> {
    let mut was_seen: Vec<bool> = positions.iter().map(Option::is_some).collect();
    let mut places: Vec<f64> = positions
        .iter()
        .flat_map(|it| it.map_or([0.0; 3], |it| it.0.coords.into()))
        .collect();
    tape.flags("was_seen", &mut was_seen)?;
    tape.reals("positions", &mut places)?;
    let (places, _) = places.as_chunks::<3>();
    for ((it, place), was_seen) in positions.iter_mut().zip(places).zip(was_seen) {
        *it = was_seen.then_some(PerformancePoint(Point3::from(*place)));
    }
    Ok(())
}
