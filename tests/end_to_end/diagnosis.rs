//! What a performance says of the neutral face and of the shapes, told while it runs and at the command line.

use frontalis_analysis::{
    face::actor::{Actor, ActorParts, MarkerPlace, RankPolicy},
    format::actor_package,
    synthesis::reference_face,
};
use frontalis_proto::v1::{
    CurveSample, MarkerFrame, NeutralDoubtCause, RangeVerdict, SessionStatus,
};
use harness::{Publisher, Subscriber, TestPerformance, TestServer, assert_eventually, every_frame};

use crate::person::Person;

const SESSION: &str = "sessions/take-1";

const SMILE: [&str; 2] = ["zygomatic_major_left", "zygomatic_major_right"];

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_take_that_begins_with_a_smile_is_doubted_and_its_quietest_frames_mend_it() {
    let (anna, mut take) = (Person::new(), Take::of(&reference_face::actor()).await);
    let url = take.server.url();
    let smiling = take.perform(1..=60, |_| 0.6).await;
    let doubt = take.status().await.neutral_doubt.unwrap();
    assert_eq!(doubt.cause(), NeutralDoubtCause::LooksContracted);
    assert!(doubt.residual_cm > doubt.expected_cm, "{doubt:?}");
    assert!(doubt.advice.contains("recenter"), "{doubt:?}");
    let show = format!("session show --server {url} take-1");
    let shown = anna.does(&show).await;
    assert!(shown.contains("the neutral face is in doubt"), "{shown}");
    assert!(shown.contains(&doubt.advice), "{shown}");
    assert!(take.smile(&smiling) < 0.3, "taken for a face at rest");

    // It fades in a quarter of a second; then the face is at rest for two.
    take.perform(61..=330, |number| 0.6 - 0.02 * (number - 60) as f64)
        .await;
    anna.does(&format!(
        "session recenter --server {url} take-1 --quietest"
    ))
    .await;
    let status = take.status().await;
    assert_eq!(
        (status.neutral_doubt, status.alignment_problem),
        (None, String::new())
    );
    let shown = anna.does(&show).await;
    assert!(!shown.contains("in doubt"), "{shown}");
    let smiling = take.perform(331..=450, |_| 0.8).await;
    let (smile, expected) = (take.smile(&smiling), 0.8);
    assert!((smile - expected).abs() < 0.05, "{smile}");
    take.server.stop().await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_shape_that_is_too_weak_is_said_while_the_take_runs() {
    let (anna, mut take) = (Person::new(), Take::of(&with_a_weak_smile()).await);
    take.perform(1..=40, |_| 0.0).await;
    let waves = |number: u64| 0.5 - 0.5 * (number as f64 * std::f64::consts::TAU / 120.0).cos();
    take.perform(41..=640, waves).await;
    // What it says is at most 250 ms old.
    assert_eventually!(
        take.status()
            .await
            .ranges
            .iter()
            .any(|it| it.verdict() == RangeVerdict::TooWeak && it.n_frames >= 155)
    );
    let ranges = take.status().await.ranges;
    let range = |name: &str| ranges.iter().find(|it| it.control == name).unwrap();
    for name in SMILE {
        let range = range(name);
        println!("{range:?}");
        assert_eq!(range.verdict(), RangeVerdict::TooWeak, "{range:?}");
        assert!(range.sentence.contains("make it stronger"), "{range:?}");
        let (bounded, unbounded) = (range.bounded.unwrap(), range.unbounded.unwrap());
        assert!(bounded.p99 <= 1.0 && unbounded.p99 > 1.15, "{range:?}");
        assert!(range.max <= 1.0, "{range:?}");
    }
    let still = range("frontalis_left");
    assert_eq!(still.verdict(), RangeVerdict::NotYetSeen);
    assert!(!still.sentence.is_empty());
    let show = format!("session show --server {} take-1", take.server.url());
    let shown = anna.does(&show).await;
    assert!(shown.contains("zygomatic_major_left: too weak"), "{shown}");
    take.server.stop().await;
}

/// The reference face, whose artist drew half of what a smile moves.
fn with_a_weak_smile() -> Actor {
    let actor = reference_face::actor();
    let mut basis = actor.basis().clone();
    for name in SMILE {
        let muscle = actor.muscle_set().index_of(name).unwrap();
        for displacement in &mut basis.displacements_cm[muscle] {
            *displacement *= 0.5;
        }
    }
    let places = actor.virtual_markers().iter();
    let places = places.map(|it| MarkerPlace::OnTriangle(*it));
    let parts = ActorParts {
        display_name: "a draft".to_owned(),
        muscle_set: actor.muscle_set().id().to_owned(),
        mesh: actor.mesh().clone(),
        muscles: actor.muscle_set().muscles().to_vec(),
        basis,
        markers: actor.markers().iter().cloned().zip(places).collect(),
    };
    Actor::new(parts, RankPolicy::Refuse).unwrap().0
}

/// A session of some actor's package, which the reference face performs.
struct Take {
    server: TestServer,
    performance: TestPerformance,
    publisher: Publisher,
    subscriber: Subscriber,
}

impl Take {
    async fn of(actor: &Actor) -> Self {
        let server = TestServer::start().await;
        let package = actor_package::write_glb(actor);
        server.import("draft", &package).await.unwrap();
        server
            .create_session("take-1", "actors/draft")
            .await
            .unwrap();
        let performance = TestPerformance::reference();
        let start = performance.start(SESSION, "camera-1");
        Self {
            publisher: Publisher::open(&server, start).await.unwrap(),
            subscriber: Subscriber::open(&server, every_frame(SESSION))
                .await
                .unwrap(),
            server,
            performance,
        }
    }

    /// Frames in which both sides smile as `smile` says of their number; the sample of the last.
    async fn perform(
        &mut self,
        numbers: std::ops::RangeInclusive<u64>,
        smile: impl Fn(u64) -> f64,
    ) -> CurveSample {
        let last = *numbers.end();
        let frames: Vec<_> = numbers
            .map(|it| self.frame(it, smile(it).max(0.0)))
            .collect();
        for frames in frames.chunks(60) {
            self.publisher.publish(frames.to_vec()).await;
        }
        let mut samples = self.subscriber.samples_through(last).await.unwrap();
        samples.pop().unwrap()
    }

    fn frame(&self, number: u64, smile: f64) -> MarkerFrame {
        let controls = &self.subscriber.header.controls;
        let activations: Vec<_> = controls
            .iter()
            .map(|it| {
                if SMILE.contains(&it.name.as_str()) {
                    smile
                } else {
                    0.0
                }
            })
            .collect();
        self.performance.frame_of(number, &activations)
    }

    /// How far the left side smiles in a sample.
    fn smile(&self, sample: &CurveSample) -> f32 {
        let mut controls = self.subscriber.header.controls.iter();
        let smile = controls.position(|it| it.name == SMILE[0]).unwrap();
        sample.activations[smile]
    }

    async fn status(&self) -> SessionStatus {
        self.server.session(SESSION).await.status.unwrap()
    }
}
