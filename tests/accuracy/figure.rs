//! How figures are written.

/// Four decimals, without the zero before the point.
pub fn error(value: f64) -> String {
    without_zero(&format!("{value:.4}"))
}

/// Three decimals with the sign.
pub fn signed(value: f64) -> String {
    let text = format!("{:.3}", value.abs());
    let sign = if value < 0.0 && text != "0.000" {
        "−"
    } else {
        "+"
    };
    format!("{sign}{}", without_zero(&text))
}

/// Two decimals: a multiple of something else.
pub fn ratio(value: f64) -> String {
    format!("{value:.2}")
}

/// Per cent, one decimal.
pub fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Mean ± standard deviation.
pub fn mean_and_spread(values: &[f64]) -> String {
    format!("{} ± {}", error(mean(values)), error(spread(values)))
}

/// The mean of some values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The standard deviation of a sample.
fn spread(values: &[f64]) -> f64 {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|it| (it - mean).powi(2)).sum();
    (squares / values.len().saturating_sub(1).max(1) as f64).sqrt()
}

fn without_zero(text: &str) -> String {
    text.strip_prefix("0.")
        .map_or(text.to_owned(), |it| format!(".{it}"))
}
