//! The faces on which accuracy is measured.

use std::{path::Path, sync::Arc};

use frontalis_analysis::{
    face::actor::{Actor, RankPolicy},
    format::actor_package,
    synthesis::reference_face,
};

/// The reference face with its 27 markers that muscles move, without the 5 on the skull.
pub fn reference() -> Arc<Actor> {
    let mut parts = reference_face::actor_parts();
    parts.markers.retain(|(marker, _)| !marker.head_fixed);
    Arc::new(Actor::new(parts, RankPolicy::Refuse).unwrap().0)
}

/// The scan-derived actor of a package in the data bundle: `muscle16_27`, `facs30_27`, `facs30_60`.
///
/// # Panics
///
/// When the package is not there or not sound.
pub fn scanned(data: &Path, package: &str) -> Arc<Actor> {
    let path = data.join(format!("actors/ict_{package}.zip"));
    let bytes = std::fs::read(&path).unwrap();
    Arc::new(
        actor_package::read(&bytes, RankPolicy::Refuse)
            .unwrap()
            .actor,
    )
}

/// Indices of the muscles that close an eye.
pub fn eyelids(actor: &Actor) -> Vec<usize> {
    let closes = |name: &str| name.contains("orbicularis_oculi") || name.contains("EyeBlink");
    let muscles = actor.muscle_set().muscles().iter();
    (muscles.enumerate().filter(|(_, it)| closes(&it.name)))
        .map(|(index, _)| index)
        .collect()
}
