//! The demo's own server: started, awaited, and ended by SIGTERM so that it drains.

use std::{
    fs::{self, File},
    io::ErrorKind,
    net::{SocketAddr, TcpListener},
    os::unix::process::ExitStatusExt as _,
    path::{Path, PathBuf},
    process::Stdio,
    time::Duration,
};

use anyhow::{Context as _, bail};
use frontalis_client::connection::{self, Channel};
use rustix::process::{Pid, Signal, kill_process};
use tokio::{
    process::{Child, Command},
    time::{sleep, timeout},
};
use tonic_health::pb::{
    HealthCheckRequest, health_check_response::ServingStatus, health_client::HealthClient,
};

const READY_TIMEOUT: Duration = Duration::from_secs(15);
const READY_POLL: Duration = Duration::from_millis(50);
/// A server drains within five seconds (CONTRACTS O-13).
const STOP_TIMEOUT: Duration = Duration::from_secs(7);

/// A running server. Dropped without [`stop`](Self::stop) it is killed.
pub struct ServerProcess {
    child: Child,
    url: String,
    log: PathBuf,
}

impl ServerProcess {
    pub fn start(
        listen: &SocketAddr,
        data_dir: &Path,
        program: Option<&Path>,
    ) -> anyhow::Result<Self> {
        check_port_is_free(listen)?;
        let program = program.map_or_else(beside_this_program, |it| Ok(it.to_owned()))?;
        fs::create_dir_all(data_dir)
            .with_context(|| format!("cannot make the directory {}", data_dir.display()))?;
        let log = data_dir.join("server.log");
        let log_file =
            File::create(&log).with_context(|| format!("cannot write {}", log.display()))?;
        let child = Command::new(&program)
            .arg("--listen")
            .arg(listen.to_string())
            .arg("--data-dir")
            .arg(data_dir)
            .stdin(Stdio::null())
            .stdout(log_file.try_clone()?)
            .stderr(log_file)
            // Its own group: Ctrl-C reaches the demo, which then ends the server in order.
            .process_group(0)
            .kill_on_drop(true)
            .spawn()
            .with_context(|| format!("cannot start the server {}", program.display()))?;
        Ok(Self {
            child,
            url: format!("http://{listen}"),
            log,
        })
    }

    /// Where the server answers.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Asks the health service until it says SERVING.
    pub async fn wait_until_ready(&mut self) -> anyhow::Result<Channel> {
        let channel = connection::lazy_channel(&self.url)?;
        let mut health = HealthClient::new(channel.clone());
        let polling = async {
            loop {
                self.check_running()?;
                let request = HealthCheckRequest::default();
                if let Ok(answer) = health.check(request).await
                    && answer.into_inner().status() == ServingStatus::Serving
                {
                    return Ok::<_, anyhow::Error>(());
                }
                sleep(READY_POLL).await;
            }
        };
        match timeout(READY_TIMEOUT, polling).await {
            Ok(ready) => ready.map(|()| channel),
            Err(_) => bail!(
                "the server at {} was not ready within {} s; its log is {}",
                self.url,
                READY_TIMEOUT.as_secs(),
                self.log.display()
            ),
        }
    }

    /// Fails, with the log's last complaint, when the server is gone.
    pub fn check_running(&mut self) -> anyhow::Result<()> {
        let Some(status) = self.child.try_wait()? else {
            return Ok(());
        };
        let log = fs::read_to_string(&self.log).unwrap_or_default();
        bail!(
            "the server stopped with {status}: {} (its log is {})",
            complaint(&log),
            self.log.display()
        )
    }

    /// Ends the server in order and waits for it.
    pub async fn stop(mut self) -> anyhow::Result<()> {
        let pid = self
            .child
            .id()
            .and_then(|it| i32::try_from(it).ok())
            .and_then(Pid::from_raw);
        let Some(pid) = pid else {
            return Ok(());
        };
        kill_process(pid, Signal::TERM).context("cannot end the server")?;
        let log = self.log.display();
        if let Ok(status) = timeout(STOP_TIMEOUT, self.child.wait()).await {
            let status = status?;
            // A server that was still starting may not have listened for the signal yet.
            if !status.success() && status.signal() != Some(Signal::TERM.as_raw()) {
                bail!("the server ended with {status}; its log is {log}");
            }
            return Ok(());
        }
        self.child.kill().await?;
        bail!(
            "the server did not end within {} s and was killed; its log is {log}",
            STOP_TIMEOUT.as_secs()
        )
    }
}

/// The last line of a log that says why the program failed; without one, its last line.
fn complaint(log: &str) -> &str {
    let says_why = |it: &&str| it.starts_with("frontalis-server:") || it.contains("ERROR");
    let mut lines = log.lines().map(str::trim).filter(|it| !it.is_empty());
    let last = lines.clone().next_back();
    lines
        .rfind(says_why)
        .or(last)
        .unwrap_or("it wrote no reason")
}

/// Says in one line that the port is taken, before anything is started.
fn check_port_is_free(listen: &SocketAddr) -> anyhow::Result<()> {
    match TcpListener::bind(listen) {
        Ok(_) => Ok(()),
        Err(error) if error.kind() == ErrorKind::AddrInUse => {
            bail!(
                "{listen} is in use by another program: stop it, or give --listen 127.0.0.1:PORT (make demo DEMO_LISTEN=127.0.0.1:PORT)"
            )
        }
        Err(error) => Err(error).with_context(|| format!("cannot listen on {listen}")),
    }
}

fn beside_this_program() -> anyhow::Result<PathBuf> {
    let program = std::env::current_exe()?.with_file_name("frontalis-server");
    if !program.exists() {
        bail!(
            "{} does not exist: build the server, or name it with --server-bin",
            program.display()
        );
    }
    Ok(program)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_busy_port_is_said_in_one_line() {
        let taken = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = taken.local_addr().unwrap();
        let error = check_port_is_free(&address).unwrap_err().to_string();
        assert!(error.contains(&address.to_string()) && error.contains("in use"));
        assert!(error.contains("DEMO_LISTEN="));
        assert_eq!(error.lines().count(), 1);
    }

    #[test]
    fn a_failed_server_is_quoted_with_the_line_that_says_why() {
        let log =
            "INFO opening\nfrontalis-server: the data directory is in use\n  by process 7\n\n";
        let why = "frontalis-server: the data directory is in use";
        assert_eq!(complaint(log), why);
        assert_eq!(complaint("Killed\n"), "Killed");
        assert!(!complaint("").is_empty());
    }
}
