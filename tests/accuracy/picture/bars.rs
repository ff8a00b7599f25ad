//! The error of each muscle as bars, plain above default.

use frontalis_analysis::face::muscle::Muscle;

use crate::figure::error;

const WIDTH: f64 = 900.0;
const TOP: f64 = 34.0;
const LEFT: f64 = 190.0;
const RIGHT: f64 = 70.0;
const ROW_HEIGHT: f64 = 26.0;
const BAR_HEIGHT: f64 = 10.0;

/// What is drawn: the mean of |error| of every muscle.
pub struct Chart<'a> {
    pub title: &'a str,
    pub muscles: &'a [Muscle],
    pub plain: &'a [f64],
    pub default: &'a [f64],
}

impl Chart<'_> {
    /// The picture.
    pub fn svg(&self) -> String {
        let height = TOP + self.muscles.len() as f64 * ROW_HEIGHT + 10.0;
        let title = format!("{}: mean |error| of plain (above) and default", self.title);
        let mut drawing = super::drawing(WIDTH, height, &title);
        let largest = self
            .plain
            .iter()
            .chain(self.default)
            .copied()
            .fold(1e-6, f64::max);
        let scale = (WIDTH - LEFT - RIGHT) / largest;
        for (row, muscle) in self.muscles.iter().enumerate() {
            let top = TOP + row as f64 * ROW_HEIGHT;
            drawing.text(10.0, top + 14.0, "name", &muscle.name);
            let bars = [(self.plain, "plain-bar"), (self.default, "default-bar")];
            for (index, (values, class)) in bars.into_iter().enumerate() {
                let y = top + index as f64 * (BAR_HEIGHT + 1.0);
                let width = scale * values[row];
                drawing.bar([LEFT, y], width, BAR_HEIGHT, class);
                drawing.text(
                    LEFT + width + 5.0,
                    y + BAR_HEIGHT,
                    "name",
                    &error(values[row]),
                );
            }
        }
        drawing.finish()
    }
}
