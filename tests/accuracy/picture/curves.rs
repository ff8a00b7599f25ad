//! Curves against truth: the muscles that move most, one below the other, over the same seconds.

use frontalis_analysis::face::muscle::Muscle;
use harness::accuracy::curves::{Curves, standard_deviation};

use super::Drawing;

/// Muscles shown, and seconds at most.
const N_MUSCLES: usize = 6;
const SECONDS: f64 = 8.0;

/// Frames between two points.
const STRIDE: usize = 2;

const WIDTH: f64 = 900.0;
const TOP: f64 = 50.0;
const LEFT: f64 = 10.0;
const ROW_HEIGHT: f64 = 90.0;
const CURVE_HEIGHT: f64 = 62.0;

/// What is drawn.
pub struct Chart<'a> {
    pub title: &'a str,
    pub muscles: &'a [Muscle],
    pub rate_hz: f64,
    pub truth: &'a Curves,
    pub plain: &'a Curves,
    pub default: &'a Curves,
}

impl Chart<'_> {
    /// The picture.
    pub fn svg(&self) -> String {
        let shown = self.liveliest();
        let height = TOP + shown.len() as f64 * ROW_HEIGHT + 10.0;
        let mut drawing = super::drawing(WIDTH, height, self.title);
        legend(&mut drawing, self.n_frames() as f64 / self.rate_hz);
        for (row, &muscle) in shown.iter().enumerate() {
            let base = TOP + (row + 1) as f64 * ROW_HEIGHT - 10.0;
            self.draw(&mut drawing, muscle, base);
        }
        drawing.finish()
    }

    fn n_frames(&self) -> usize {
        let limit = SECONDS * self.rate_hz;
        (0..self.truth.n_frames())
            .take_while(|&it| (it as f64) < limit)
            .count()
    }

    /// The muscles whose truth varies most in what is shown, in their own order.
    fn liveliest(&self) -> Vec<usize> {
        let varies =
            |&muscle: &usize| standard_deviation(&self.truth.of_muscle(muscle)[..self.n_frames()]);
        let mut muscles: Vec<usize> = (0..self.truth.n_muscles()).collect();
        muscles.sort_by(|a, b| varies(b).total_cmp(&varies(a)));
        muscles.truncate(N_MUSCLES);
        muscles.sort_unstable();
        muscles
    }

    fn draw(&self, drawing: &mut Drawing, muscle: usize, base: f64) {
        let right = WIDTH - LEFT;
        drawing.text(
            LEFT,
            base - CURVE_HEIGHT - 4.0,
            "name",
            &self.muscles[muscle].name,
        );
        for height in [0.0, CURVE_HEIGHT] {
            drawing.line([LEFT, base - height], [right, base - height], "axis");
        }
        let step = (right - LEFT) / self.n_frames().max(2).saturating_sub(1) as f64;
        let curves = [
            (self.truth, "truth"),
            (self.plain, "plain"),
            (self.default, "default"),
        ];
        for (curves, class) in curves {
            let curve = curves.of_muscle(muscle);
            let frames = curve[..self.n_frames()].iter().enumerate().step_by(STRIDE);
            let points = frames.map(|(k, x)| [LEFT + k as f64 * step, base - CURVE_HEIGHT * x]);
            drawing.path(points, class);
        }
    }
}

fn legend(drawing: &mut Drawing, seconds: f64) {
    for (index, class) in ["truth", "plain", "default"].into_iter().enumerate() {
        let x = LEFT + 90.0 * index as f64;
        drawing.line([x, 36.0], [x + 24.0, 36.0], class);
        drawing.text(x + 30.0, 40.0, "name", class);
    }
    let note = format!("0 to 1 over {seconds:.1} s");
    drawing.text(WIDTH - 140.0, 40.0, "name", &note);
}
