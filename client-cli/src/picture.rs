//! Pictures as SVG: the same figures give the same text, one line an element, so that changes can be read.

/// What every picture has; both a light and a dark page can be behind it, so it brings its own ground.
const STYLE: &str = "\
text { font: 12px sans-serif; fill: #333 }
.title { font-size: 14px }
";

/// Points of a polyline in a line of text.
const POINTS_A_LINE: usize = 12;

/// A drawing, in pixels from its upper left corner.
#[derive(Clone, Debug)]
pub struct Drawing {
    text: String,
}

impl Drawing {
    /// An empty one of a width and a height; `style` is the CSS of the classes that are drawn with.
    pub fn new([width, height]: [f64; 2], title: &str, style: &str) -> Self {
        let mut it = Self {
            text: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n\
                 <style>\n{STYLE}{style}</style>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
            ),
        };
        it.text(10.0, 20.0, "title", title);
        it
    }

    /// Words that start at a place.
    pub fn text(&mut self, x: f64, y: f64, class: &str, words: &str) {
        let words = escaped(words);
        self.element(&format!(
            "<text x=\"{x}\" y=\"{y}\" class=\"{class}\">{words}</text>"
        ));
    }

    /// A line from one place to another.
    pub fn line(&mut self, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2], class: &str) {
        self.element(&format!(
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" class=\"{class}\"/>"
        ));
    }

    /// A filled rectangle.
    pub fn bar(&mut self, [x, y]: [f64; 2], width: f64, height: f64, class: &str) {
        self.element(&format!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" class=\"{class}\"/>"
        ));
    }

    /// A polyline through these points, which a filled class closes.
    pub fn path(&mut self, points: impl Iterator<Item = [f64; 2]>, class: &str) {
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

    /// The SVG.
    pub fn finish(self) -> String {
        self.text + "</svg>\n"
    }
}

/// As XML has it: names of muscles and takes are whatever somebody called them.
fn escaped(words: &str) -> String {
    let is_text = |it: &char| !it.is_control();
    words
        .chars()
        .filter(is_text)
        .fold(String::new(), |mut text, it| {
            match it {
                '&' => text.push_str("&amp;"),
                '<' => text.push_str("&lt;"),
                '>' => text.push_str("&gt;"),
                _ => text.push(it),
            }
            text
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_become_elements() {
        let drawing = Drawing::new([10.0, 10.0], "<script>&\u{0}", "");
        let svg = drawing.finish();
        assert!(svg.contains("&lt;script&gt;&amp;</text>"), "{svg}");
    }
}
