//! `scipy.optimize.lsq_linear`, least squares within [0, 1] by an independent program.
//!
//! Each thread talks to a Python of its own through pipes: a take's basis and displacements in, its curves out.

use std::{
    io::{Read as _, Write as _},
    path::Path,
    process::{Child, ChildStdin, ChildStdout, Command, Stdio},
};

use harness::accuracy::curves::Curves;

use crate::stabilized::Stabilized;

/// A Python with scipy, waiting for takes.
pub struct Scipy {
    child: Child,
    input: Option<ChildStdin>,
    output: ChildStdout,
}

impl Scipy {
    /// Starts one; `None` without Python or without scipy.
    pub fn start() -> Option<Self> {
        let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut child = Command::new(tests.join("../.venv-accuracy/bin/python"))
            .arg(tests.join("accuracy/bounded.py"))
            // Threads of the linear algebra would sum in an order of their own.
            .env("OPENBLAS_NUM_THREADS", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .ok()?;
        let input = child.stdin.take();
        let mut output = child.stdout.take()?;
        let mut ready = [0; 1];
        let started = output.read_exact(&mut ready).is_ok();
        let mut scipy = Self {
            child,
            input,
            output,
        };
        if !started {
            scipy.end();
            return None;
        }
        Some(scipy)
    }

    /// The curves of a take; frames without a pose keep those of the frame before.
    pub fn solve(&mut self, problem: &Stabilized) -> Curves {
        let (n_rows, n_frames) = (problem.basis.len(), problem.displacements.len());
        let m = problem.n_muscles();
        let unseen = vec![f64::NAN; n_rows];
        let frames = problem
            .displacements
            .iter()
            .map(|it| it.as_ref().unwrap_or(&unseen));
        let values = problem.basis.iter().chain(frames).flatten();
        let sizes = [n_rows, m, n_frames].map(|it| (it as u64).to_le_bytes());
        let mut job: Vec<u8> = sizes.as_flattened().to_vec();
        job.extend(values.flat_map(|it| it.to_le_bytes()));
        let input = self.input.as_mut().unwrap();
        input.write_all(&job).unwrap();
        input.flush().unwrap();
        let mut answer = vec![0; 8 * m * n_frames];
        self.output.read_exact(&mut answer).unwrap();
        let (values, _) = answer.as_chunks::<8>();
        let values: Vec<f64> = values.iter().map(|it| f64::from_le_bytes(*it)).collect();
        Curves(values.chunks_exact(m).map(<[f64]>::to_vec).collect())
    }

    /// Closing its input ends it.
    fn end(&mut self) {
        self.input = None;
        drop(self.child.wait());
    }
}

impl Drop for Scipy {
    fn drop(&mut self) {
        self.end();
    }
}
