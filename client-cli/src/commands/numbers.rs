//! Figures on the command line, refused outside their range before anything starts.

/// A finite number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    within(text, f64::MIN_POSITIVE, f64::MAX, "a number above 0")
}

/// A finite number, zero or above.
pub fn not_negative(text: &str) -> Result<f64, String> {
    within(text, 0.0, f64::MAX, "a number of 0 or above")
}

/// A share, from 0 up to 1.
pub fn fraction(text: &str) -> Result<f64, String> {
    within(text, 0.0, 1.0, "a number from 0 to 1")
}

/// How strong a term of the objective is, as on the wire.
pub fn strength(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("expected a strength from 0 to 1".to_owned()),
    }
}

/// A frame rate that a session takes.
pub fn rate_hz(text: &str) -> Result<f64, String> {
    within(text, 1.0, 1_000.0, "a rate from 1 to 1000 Hz")
}

fn within(text: &str, low: f64, high: f64, expected: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (low..=high).contains(&value) => Ok(value),
        _ => Err(format!("expected {expected}")),
    }
}
