//! Pictures as SVG: the same figures give the same text, one line an element, so that changes can be read.

pub mod bars;
pub mod curves;

use frontalis_client::picture::Drawing;

/// What the charts are drawn with.
const STYLE: &str = "\
.truth { stroke: #999; stroke-width: 3; fill: none }
.plain { stroke: #d98324; stroke-width: 1; fill: none }
.default { stroke: #1f6fb2; stroke-width: 1.5; fill: none }
.plain-bar { fill: #d98324 }
.default-bar { fill: #1f6fb2 }
.axis { stroke: #ddd }
";

/// An empty chart.
fn drawing(width: f64, height: f64, title: &str) -> Drawing {
    Drawing::new([width, height], title, STYLE)
}
