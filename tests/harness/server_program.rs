//! The server as a program of its own, whose memory can be measured.

use std::{
    io::{BufRead as _, BufReader},
    net::SocketAddr,
    path::Path,
    process::{Child, Command, Stdio},
    time::Duration,
};

use crate::program;

/// The line that the program prints once it listens, before its address.
const LISTENING: &str = "listening on http://";

/// A running program; killed when it is dropped.
pub struct ServerProgram {
    child: Child,
    address: SocketAddr,
}

impl Drop for ServerProgram {
    fn drop(&mut self) {
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

impl ServerProgram {
    /// Starts it with a configuration file, and waits until it listens.
    pub fn start(config: &Path) -> Self {
        let mut child = Command::new(program("frontalis-server"))
            .env_clear()
            .args(["--log", "error", "--config"])
            .arg(config)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap())
            .read_line(&mut line)
            .unwrap();
        let address = line.trim().strip_prefix(LISTENING).unwrap();
        let address = address.parse().unwrap();
        Self { child, address }
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Resident memory, bytes.
    pub fn resident_bytes(&self) -> u64 {
        self.status_bytes("VmRSS:")
    }

    /// Memory that is reserved for data, whether written or not, bytes.
    pub fn data_bytes(&self) -> u64 {
        self.status_bytes("VmData:")
    }

    /// The most resident memory since the start or [`Self::forget_peak`], bytes.
    pub fn peak_resident_bytes(&self) -> u64 {
        self.status_bytes("VmHWM:")
    }

    /// Lets the peak start over.
    pub fn forget_peak(&self) {
        let file = format!("/proc/{}/clear_refs", self.child.id());
        std::fs::write(file, "5").unwrap();
    }

    /// Its process.
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Processor time of all its threads so far, nanoseconds.
    pub fn cpu_nanos(&self) -> u64 {
        let folder = format!("/proc/{}/task", self.child.id());
        let threads = std::fs::read_dir(folder).unwrap();
        let nanos = |thread: std::io::Result<std::fs::DirEntry>| -> u64 {
            // A thread may end between the two looks.
            let text = std::fs::read_to_string(thread.unwrap().path().join("schedstat"));
            text.map_or(0, |it| {
                it.split_whitespace().next().unwrap().parse().unwrap()
            })
        };
        threads.map(nanos).sum()
    }

    /// Open files and sockets.
    pub fn n_open_files(&self) -> usize {
        let folder = format!("/proc/{}/fd", self.child.id());
        std::fs::read_dir(folder).unwrap().count()
    }

    fn status_bytes(&self, key: &str) -> u64 {
        let file = format!("/proc/{}/status", self.child.id());
        let status = std::fs::read_to_string(file).unwrap();
        let line = status.lines().find_map(|it| it.strip_prefix(key)).unwrap();
        let kib: u64 = line.trim().trim_end_matches(" kB").parse().unwrap();
        kib * 1024
    }

    /// Asks it to drain.
    pub fn terminate(&self) {
        let id = self.child.id().to_string();
        let sent = Command::new("kill").args(["-TERM", &id]).status().unwrap();
        assert!(sent.success());
    }

    /// Ends it at once, as a crash does.
    pub fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Waits until it is gone; true: nothing had to be cut.
    pub async fn wait(&mut self) -> bool {
        self.exit_code().await == Some(0)
    }

    /// Waits until it is gone; `None`: a signal ended it.
    pub async fn exit_code(&mut self) -> Option<i32> {
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.code();
            }
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    }
}
