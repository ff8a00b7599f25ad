//! Waiting for what another task will do, without guessing how long it takes.

/// Waits until the condition holds, asking again every few milliseconds; fails after 20 s.
///
/// The condition may await.
#[macro_export]
macro_rules! assert_eventually {
    ($condition:expr) => {
        $crate::assert_eventually!($condition, "{}", stringify!($condition))
    };
    ($condition:expr, $($message:tt)+) => {{
        let mut attempts = 0_u32;
        while !$condition {
            attempts += 1;
            assert!(attempts < 2_000, "not so after 20 s: {}", format!($($message)+));
            tokio::time::sleep(std::time::Duration::from_millis(10)).await;
        }
    }};
}
