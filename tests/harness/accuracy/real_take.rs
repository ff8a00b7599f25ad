//! Takes with real people's performances behind them, out of the data bundle.

use std::path::Path;

use frontalis_analysis::{
    face::{
        actor::Actor,
        marker::{FrameIndex, MarkerFrame},
    },
    format::trc,
};

use super::{curves::Curves, take::Take};

/// Seeds of what goes wrong when a take is corrupted.
pub const CORRUPTION_SEEDS: [u64; 5] = [301, 302, 303, 304, 305];

/// A take of the bundle, and the package of the actor it is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RealTake {
    /// Who performs.
    pub person: &'static str,
    /// The actor's package: muscle set and number of markers.
    pub package: &'static str,
}

impl RealTake {
    /// The actors' packages.
    pub const PACKAGES: [&str; 3] = ["muscle16_27", "facs30_60", "facs30_27"];

    /// Every take with a moving head, by package.
    pub const ALL: [Self; 8] = [
        Self::new("ns164", "muscle16_27"),
        Self::new("facegood_speech", "muscle16_27"),
        Self::new("llv", "muscle16_27"),
        Self::new("ns164", "facs30_60"),
        Self::new("llv", "facs30_60"),
        Self::new("ns164", "facs30_27"),
        Self::new("facegood_speech", "facs30_27"),
        Self::new("llv", "facs30_27"),
    ];

    /// The take of a person on a package.
    pub const fn new(person: &'static str, package: &'static str) -> Self {
        Self { person, package }
    }

    /// The take's name in the bundle, without what the head does.
    pub fn name(&self) -> String {
        format!("{}_{}", self.person, self.package)
    }

    /// Reads the take with the moving head.
    ///
    /// # Panics
    ///
    /// When a file is not there, or its markers or muscles are not the actor's.
    pub fn read(&self, data: &Path, actor: &Actor) -> Take {
        let folder = data.join("takes");
        let name = self.name();
        let markers = std::fs::read(folder.join(format!("{name}_moving.trc"))).unwrap();
        let truth = std::fs::read_to_string(folder.join(format!("{name}.truth.csv"))).unwrap();
        let file = trc::parse(&markers).unwrap();
        let names = actor.markers().iter().map(|it| it.name.as_str());
        assert!(names.eq(file.marker_names.iter().map(String::as_str)));
        Take {
            rate_hz: file.rate_hz,
            unit: file.unit,
            truth: contractions(&truth, actor, &file),
            frames: file.frames.iter().map(|it| frame(it, &file)).collect(),
        }
    }
}

fn frame(row: &trc::TrcFrame, file: &trc::TrcTake) -> MarkerFrame {
    let seen = |[x, y, z]: &[f32; 3]| {
        let place = file.unit.performance_point(*x, *y, *z);
        place.0.iter().all(|it| it.is_finite()).then_some(place)
    };
    MarkerFrame {
        index: FrameIndex(row.number),
        capture_time_nanos: row.capture_time_nanos(),
        positions: row.positions.iter().map(seen).collect(),
    }
}

fn contractions(text: &str, actor: &Actor, file: &trc::TrcTake) -> Curves {
    let mut lines = text.lines();
    let muscles = lines.next().unwrap().split(',').skip(1);
    assert!(muscles.eq(actor.muscle_set().muscles().iter().map(|it| &it.name)));
    let rows = lines.zip(&file.frames).map(|(line, frame)| {
        let mut fields = line.split(',');
        assert_eq!(fields.next().unwrap(), frame.number.to_string());
        fields.map(|it| it.parse().unwrap()).collect()
    });
    Curves(rows.collect())
}
