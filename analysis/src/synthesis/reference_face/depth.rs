//! How far forward the skin of the reference face lies over (x, y).
//!
//! z = D(y) (1 − q^2.35)^0.62 + ridge(y) exp(−(|x|/σ(y))^2.4) + Σₖ aₖ exp(−½((|x| − cx)/sx)² − ½((y − cy)/sy)²),
//! where q = |x| / W(y): a head flatter than an ellipse in front, then the nose, then every bump.

use std::sync::LazyLock;

use super::{pchip::Pchip, tables};

static HALF_WIDTH: LazyLock<Pchip> = LazyLock::new(|| curve(tables::HALF_WIDTH));
static CENTER_DEPTH: LazyLock<Pchip> = LazyLock::new(|| curve(tables::CENTER_DEPTH));
static NOSE_HEIGHT: LazyLock<Pchip> = LazyLock::new(|| curve(tables::NOSE_HEIGHT));
static NOSE_WIDTH: LazyLock<Pchip> = LazyLock::new(|| curve(tables::NOSE_WIDTH));

fn curve<const N: usize>((x, y): ([f64; N], [f64; N])) -> Pchip {
    Pchip::new(&x, &y)
}

/// z of the skin at (`x_cm`, `y_cm`), before the lids rest on the eyeballs; the same on both sides.
pub(super) fn depth_cm(x_cm: f64, y_cm: f64) -> f64 {
    let x = x_cm.abs();
    let bumps: f64 = tables::BUMPS.iter().map(|bump| height(bump, x, y_cm)).sum();
    head(x, y_cm) + nose(x, y_cm) + bumps
}

fn head(x: f64, y: f64) -> f64 {
    let q = (x / HALF_WIDTH.at(y)).min(0.9999);
    CENTER_DEPTH.at(y) * (1.0 - q.powf(2.35)).powf(0.62)
}

fn nose(x: f64, y: f64) -> f64 {
    let (below, above) = tables::NOSE_SPAN;
    if y <= below || y >= above {
        return 0.0;
    }
    NOSE_HEIGHT.at(y) * (-(x / NOSE_WIDTH.at(y)).powf(2.4)).exp()
}

fn height(bump: &tables::Bump, x: f64, y: f64) -> f64 {
    let across = (x - bump.center.0) / bump.spread.0;
    let along = (y - bump.center.1) / bump.spread.1;
    bump.height * (-0.5 * across * across - 0.5 * along * along).exp()
}
