//! The settings that are compared.

use frontalis_analysis::analyzer::{MarkerSettings, Objective};

/// The paper's objective with outlying markers weighed down, and nothing else.
pub fn robust_only() -> MarkerSettings {
    MarkerSettings {
        objective: Objective {
            robust: true,
            ..Objective::plain()
        },
        ..MarkerSettings::default()
    }
}

/// The default without its L1 term, which pulls contractions towards 0 on purpose: what standard errors speak of.
pub fn without_sparsity() -> MarkerSettings {
    MarkerSettings {
        objective: Objective {
            sparsity: 0.0,
            ..Objective::default()
        },
        ..MarkerSettings::default()
    }
}
