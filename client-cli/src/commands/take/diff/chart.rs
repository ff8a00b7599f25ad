//! Two takes' curves as a picture: every muscle a row, the first take below the second, what is between them above both.

use frontalis_client::{
    picture::Drawing,
    take_difference::{TakeDifference, timeline::Extent},
};

const STYLE: &str = "\
.first { fill: #d98324; stroke: #d98324; stroke-width: 1; fill-opacity: .6 }
.second { fill: #1f6fb2; stroke: #1f6fb2; stroke-width: 1; fill-opacity: .6 }
.apart { fill: #b3261e }
.axis { stroke: #ddd }
";

const WIDTH: f64 = 960.0;
const TOP: f64 = 56.0;
const LEFT: f64 = 10.0;
const ROW_HEIGHT: f64 = 96.0;
const CURVE_HEIGHT: f64 = 56.0;
const APART_HEIGHT: f64 = 14.0;

/// The picture; `names` are those of the takes.
pub fn svg(difference: &TakeDifference, names: [&str; 2]) -> String {
    let height = TOP + difference.controls.len() as f64 * ROW_HEIGHT + 10.0;
    let title = format!(
        "{} and {}: {} frames in both, {} the same",
        names[0], names[1], difference.n_frames, difference.n_same
    );
    let mut drawing = Drawing::new([WIDTH, height], &title, STYLE);
    legend(&mut drawing, difference, names);
    for (index, control) in difference.controls.iter().enumerate() {
        let base = TOP + (index + 1) as f64 * ROW_HEIGHT - 8.0;
        let words = format!(
            "{}: largest {:.4}, RMS {:.4}",
            control.name,
            control.max(),
            control.rms()
        );
        drawing.text(
            LEFT,
            base - CURVE_HEIGHT - APART_HEIGHT - 4.0,
            "name",
            &words,
        );
        row(&mut drawing, difference, index, base);
    }
    drawing.finish()
}

fn legend(drawing: &mut Drawing, difference: &TakeDifference, names: [&str; 2]) {
    let entries = [
        ("first", names[0]),
        ("second", names[1]),
        ("apart", "difference"),
    ];
    for (index, (class, name)) in entries.into_iter().enumerate() {
        let x = LEFT + 240.0 * index as f64;
        drawing.bar([x, 32.0], 20.0, 8.0, class);
        drawing.text(x + 26.0, 40.0, "name", name);
    }
    let timeline = &difference.timeline;
    let note = format!(
        "0 to 1, frames {} to {}",
        timeline.first_frame(),
        timeline.last_frame()
    );
    drawing.text(WIDTH - 200.0, 40.0, "name", &note);
}

fn row(drawing: &mut Drawing, difference: &TakeDifference, control: usize, base: f64) {
    let right = WIDTH - LEFT;
    for height in [0.0, CURVE_HEIGHT] {
        drawing.line([LEFT, base - height], [right, base - height], "axis");
    }
    let spans = difference.timeline.of_control(control);
    let step = (right - LEFT) / spans.len().max(1) as f64;
    let place = |index: usize| LEFT + index as f64 * step;
    let spans: Vec<_> = spans.collect();
    for stretch in stretches(&spans) {
        band(drawing, &stretch, &place, base, "first", |it| it.first);
        band(drawing, &stretch, &place, base, "second", |it| it.second);
    }
    for (index, extent) in spans.iter().enumerate() {
        let distance = extent.map_or(0.0, |it| f64::from(it.distance).min(1.0));
        if distance > 0.0 {
            let height = APART_HEIGHT * distance.sqrt();
            let top = base - CURVE_HEIGHT - height;
            drawing.bar([place(index), top], step, height, "apart");
        }
    }
}

/// Spans in a row that have frames, each with its place.
fn stretches(spans: &[Option<Extent>]) -> Vec<Vec<(usize, Extent)>> {
    let mut all = vec![Vec::new()];
    for (index, extent) in spans.iter().enumerate() {
        match (extent, all.last_mut()) {
            (Some(extent), Some(stretch)) => stretch.push((index, *extent)),
            _ => all.push(Vec::new()),
        }
    }
    all.retain(|it| !it.is_empty());
    all
}

/// From the least to the most of each span, and back.
fn band(
    drawing: &mut Drawing,
    stretch: &[(usize, Extent)],
    place: &impl Fn(usize) -> f64,
    base: f64,
    class: &str,
    of: impl Fn(&Extent) -> [f32; 2],
) {
    let at = |(index, extent): &(usize, Extent), which: usize| {
        let value = f64::from(of(extent)[which]).clamp(0.0, 1.0);
        [place(*index), base - CURVE_HEIGHT * value]
    };
    let forth = stretch.iter().map(|it| at(it, 0));
    let back = stretch.iter().rev().map(|it| at(it, 1));
    drawing.path(forth.chain(back), class);
}
