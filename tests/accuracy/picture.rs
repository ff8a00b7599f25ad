//! Pictures as SVG: the same figures give the same text, one line an element, so that changes can be read.

pub mod bars;
pub mod curves;

/// What an SVG is drawn with; both a light and a dark page can be behind it, so it brings its own ground.
const STYLE: &str = "\
<style>
text { font: 12px sans-serif; fill: #333 }
.title { font-size: 14px }
.truth { stroke: #999; stroke-width: 3; fill: none }
.plain { stroke: #d98324; stroke-width: 1; fill: none }
.default { stroke: #1f6fb2; stroke-width: 1.5; fill: none }
.plain-bar { fill: #d98324 }
.default-bar { fill: #1f6fb2 }
.axis { stroke: #ddd }
</style>
";

/// A drawing of a size, in pixels.
struct Drawing {
    text: String,
}

impl Drawing {
    fn new(width: f64, height: f64, title: &str) -> Self {
        let mut it = Self {
            text: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n{STYLE}\
                 <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
            ),
        };
        it.text(10.0, 20.0, "title", title);
        it
    }

    /// Words that start at a place.
    fn text(&mut self, x: f64, y: f64, class: &str, words: &str) {
        self.element(&format!(
            "<text x=\"{x}\" y=\"{y}\" class=\"{class}\">{words}</text>"
        ));
    }

    fn line(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2], class: &str) {
        self.element(&format!(
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" class=\"{class}\"/>"
        ));
    }

    fn bar(&mut self, [x, y]: [f64; 2], width: f64, height: f64, class: &str) {
        self.element(&format!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" class=\"{class}\"/>"
        ));
    }

    /// A polyline, a dozen points a line of text.
    fn path(&mut self, points: impl Iterator<Item = [f64; 2]>, class: &str) {
        const POINTS_A_LINE: usize = 12;
        let point = |(index, [x, y]): (usize, [f64; 2])| {
            let separator = if index % POINTS_A_LINE == 0 {
                '\n'
            } else {
                ' '
            };
            format!("{separator}{x:.1},{y:.1}")
        };
        let points: String = points.enumerate().map(point).collect();
        self.element(&format!(
            "<polyline class=\"{class}\" points=\"{points}\"/>"
        ));
    }

    fn element(&mut self, element: &str) {
        self.text.push_str(element);
        self.text.push('\n');
    }

    fn finish(self) -> String {
        self.text + "</svg>\n"
    }
}
