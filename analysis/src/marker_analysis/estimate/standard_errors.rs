//! How far the contractions of a frame can be trusted.

use super::{super::evidence::Part, Estimator, Follower, UNKNOWN};

/// Standard deviation of the difference of mirror images of which one is not observed.
const MIRROR_DIFFERENCE: f64 = 0.2;

impl Estimator {
    /// What the posterior says, with two things that it does not know: the prior's share of the information was itself learnt
    /// from the frame, and counts half; and where a face moves the prior holds the solution back.
    pub(super) fn find_standard_errors(&mut self, x: &[f64]) {
        let (hessian, stride) = (self.qp.hessian(), self.qp.stride());
        let muscles = &self.free[..self.free.partition_point(|it| *it < x.len())];
        let pull = match &mut self.prior {
            Some(prior) if prior.is_known() => prior.pull(x, &self.expected),
            _ => &[],
        };
        let (noise, changing) = (self.noise.variance(), self.noise.changing_variance());
        let mut free = muscles.iter().enumerate().peekable();
        for (i, it) in self.standard_errors.iter_mut().enumerate() {
            if self.parts[i] == Part::Unobserved {
                // What was known of it fades as it does.
                let known = UNKNOWN * UNKNOWN - *it * *it;
                *it = (UNKNOWN * UNKNOWN - known * self.decay * self.decay).sqrt();
                free.next_if(|(_, unknown)| **unknown == i);
                continue;
            }
            let mut lag = 0.0;
            let place = free.next_if(|(_, unknown)| **unknown == i);
            let variance = if let Some((place, _)) = place {
                let row = self.posterior.row(place).iter().zip(muscles);
                let pulls = row.map(|(c, j)| c * pull.get(*j).unwrap_or(&0.0));
                lag = changing * pulls.sum::<f64>();
                self.posterior.variance(place)
            } else {
                let posterior = &mut self.posterior;
                posterior.variance_of_bound(hessian, stride, &self.free, i)
            };
            let prior_share = 1.0 - self.equations.diagonal(i) / hessian[i * stride + i];
            *it = (noise * variance * (1.0 + prior_share) + lag * lag)
                .sqrt()
                .min(UNKNOWN);
        }
        for &Follower { muscle, leader, .. } in self.mirrors.followers() {
            let error = self.standard_errors[leader].hypot(MIRROR_DIFFERENCE);
            self.standard_errors[muscle] = error.min(UNKNOWN);
        }
    }
}
