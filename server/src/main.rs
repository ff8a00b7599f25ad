//! The server's program: configuration, log, port, run, wait for the signal, exit code.

use std::{io, process::ExitCode};

use anyhow::Context as _;
use clap::Parser as _;
use frontalis_server::{
    config::{
        Config, MemoryItem,
        layers::{Flags, load},
        worst_case,
    },
    service::listener::bind,
    shutdown::{ReloadSignal, StopSignals},
    telemetry::start_log,
};
use tokio_util::sync::CancellationToken;

fn main() -> ExitCode {
    match start(&Flags::parse()) {
        Ok(code) => code,
        Err(error) => {
            // One line, the cause last, so that an operator sees it without a log reader.
            eprintln!("frontalis-server: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Exit code of a server that only showed the takes of a damaged data directory.
const RESCUED: u8 = 3;

fn start(flags: &Flags) -> anyhow::Result<ExitCode> {
    let environment = std::env::vars_os()
        .filter_map(|(name, value)| Some((name.into_string().ok()?, value.into_string().ok()?)));
    let config = load(flags, environment)?;
    if flags.check {
        print!("{}", config.to_toml());
        print_memory(&config);
        return Ok(ExitCode::SUCCESS);
    }
    start_log(&config.log)?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
        .context("the runtime cannot be started")?;
    let code = runtime.block_on(serve(config));
    // A long take that is being put into its final form is not waited for: the next start does it again.
    runtime.shutdown_background();
    code
}

async fn serve(config: Config) -> anyhow::Result<ExitCode> {
    let mut signals = StopSignals::take().context("the signals cannot be taken over")?;
    let mut hang_ups = ReloadSignal::take().context("the signals cannot be taken over")?;
    let listener = bind(config.listen, &config.transport).map_err(|error| busy(&config, error))?;
    say(&config);
    let shutdown = CancellationToken::new();
    let server = frontalis_server::run(config, listener, shutdown.clone()).await?;
    let code = match server.rescue() {
        Some(why) => {
            eprintln!(
                "frontalis-server: RESCUE: {why}\nfrontalis-server: nothing is changed; the takes that were found can be listed and exported"
            );
            ExitCode::from(RESCUED)
        }
        None => ExitCode::SUCCESS,
    };
    println!("listening on {}", server.url());
    let signal = loop {
        tokio::select! {
            signal = signals.next() => break signal,
            () = hang_ups.next() => server.reload(),
        }
    };
    tracing::info!(signal, "asked to stop");
    shutdown.cancel();
    tokio::select! {
        _ = server.stopped() => Ok(code),
        signal = signals.next() => {
            tracing::warn!(signal, "asked again, stopping at once");
            std::process::exit(1);
        }
    }
}

fn busy(config: &Config, error: io::Error) -> anyhow::Error {
    let listen = config.listen;
    match error.kind() {
        io::ErrorKind::AddrInUse => anyhow::anyhow!(
            "{listen} is in use by another program; stop it or choose another address with --listen"
        ),
        _ => anyhow::Error::new(error).context(format!("{listen} cannot be listened on")),
    }
}

/// The configuration as it takes effect, for whoever reads the log later.
fn say(config: &Config) {
    for line in config.to_toml().lines().filter(|it| !it.is_empty()) {
        tracing::info!("config: {line}");
    }
    let items = worst_case(config);
    for item in &items {
        tracing::info!(
            what = item.what,
            mib = item.bytes >> 20,
            "worst-case memory"
        );
    }
    tracing::info!(
        mib = sum_mib(&items),
        budget_mib = config.memory_budget_mib,
        "worst-case memory in all"
    );
    if config.is_exposed() && !config.is_protected() {
        let missing = config.missing_protection();
        tracing::warn!(missing, "INSECURE: others can reach this port");
    }
}

fn print_memory(config: &Config) {
    println!("\n# Worst-case memory:");
    let items = worst_case(config);
    for item in &items {
        println!("# {:>8} MiB  {}", item.bytes >> 20, item.what);
    }
    println!(
        "# {:>8} MiB  of a budget of {} MiB",
        sum_mib(&items),
        config.memory_budget_mib
    );
}

fn sum_mib(items: &[MemoryItem]) -> u64 {
    items.iter().map(|it| it.bytes).sum::<u64>() >> 20
}
