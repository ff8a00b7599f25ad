//! What can be typed after `frontalis`.

use clap::{Parser, Subcommand};

use crate::commands::{
    ConnectionArgs,
    actor::ActorCommand,
    audit::AuditCommand,
    completions::CompletionsArgs,
    demo::DemoArgs,
    login::{LoginArgs, LogoutArgs},
    publish::PublishArgs,
    server::ServerArgs,
    session::SessionCommand,
    simulate::SimulateArgs,
    solve::SolveArgs,
    take::TakeCommand,
    token::TokenCommand,
    watch::WatchArgs,
};

/// Facial motion capture over the network: markers in, muscle curves out.
#[derive(Debug, Parser)]
#[command(name = "frontalis", version, after_help = EXAMPLES, max_term_width = 110)]
pub struct Cli {
    #[command(flatten)]
    pub connection: ConnectionArgs,

    /// Answer in JSON instead of tables and bars
    #[arg(long, global = true, help_heading = "Everywhere")]
    pub json: bool,

    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "\
Examples:
  frontalis demo                                            everything at once, on this machine
  frontalis actor import face.zip --id anna                 bring in an actor
  frontalis session create --actor anna --id take-1         prepare a capture
  frontalis publish take.trc --session take-1               send a recorded performance
  frontalis watch take-1                                    see the curves live

Exit status: 0 done, 1 failed, 2 not understood.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Import, list, show, export and delete actors
    #[command(subcommand)]
    Actor(ActorCommand),
    /// Create, list, show, change, recenter and end sessions
    #[command(subcommand)]
    Session(SessionCommand),
    /// Record sessions; list, label, save, play and erase takes
    #[command(subcommand)]
    Take(TakeCommand),
    /// Publish a TRC or C3D file into a session
    Publish(PublishArgs),
    /// Follow a session's curves: live bars, CSV or JSON
    Watch(WatchArgs),
    /// Solve a TRC or C3D file without a server, as a session would
    Solve(SolveArgs),
    /// Publish a simulated five-camera capture in real time
    Simulate(SimulateArgs),
    /// Start a server and a simulated capture, and show the curves
    Demo(DemoArgs),
    /// Check a token with a server and keep it for this user
    Login(LoginArgs),
    /// Forget the token of a server
    Logout(LogoutArgs),
    /// Show the server: version, TLS, tokens, and who you are to it
    #[command(visible_alias = "status")]
    Server(ServerArgs),
    /// Make, list and take back the tokens of a server, on its own machine
    #[command(subcommand)]
    Token(TokenCommand),
    /// Check a server's audit log, on its own machine or a copy
    #[command(subcommand)]
    Audit(AuditCommand),
    /// Print the completion script of a shell
    Completions(CompletionsArgs),
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    fn parse(line: &str) -> Result<Cli, clap::Error> {
        Cli::try_parse_from(line.split_whitespace())
    }

    #[test]
    fn the_commands_are_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn the_lines_of_the_manual_are_understood() {
        for line in [
            "frontalis actor import face.zip --id anna --regularize --display-name Anna",
            "frontalis actor list --json",
            "frontalis actor show anna",
            "frontalis actor export anna out.glb",
            "frontalis actor delete anna --yes",
            "frontalis actor reference out.glb",
            "frontalis session create --actor anna --id take-1 --neutral-frames 1 --exaggeration --fixed-head --regions split",
            "frontalis session create --actor anna --align-on-request --stale-after-millis 200 --publisher-timeout-secs 5",
            "frontalis session update take-1 --exaggeration=false --actor-revision 2",
            "frontalis session recenter take-1",
            "frontalis session recenter take-1 --quietest",
            "frontalis session create --actor anna --plain --bounds jaw=0..0.8 --exclusive kiss,jaw",
            "frontalis session update take-1 --plain=false --smoothing 0.2 --sparsity 0.7 --robust --symmetry 0.1 --bounds none",
            "frontalis session end take-1",
            "frontalis --server http://10.0.0.5:7400 publish take.trc --session take-1 --fast",
            "frontalis take play take-1-19f3c2a1b00 --speed 0.5 --session again --loop",
            "frontalis take play one.mcap --keep",
            "frontalis watch take-1",
            "frontalis watch take-1 --every-frame --from-start --until-end --csv",
            "frontalis watch take-1 --every-frame --frames 100 --json",
            "frontalis solve take.trc --actor face.zip --regions split --renumber --csv",
            "frontalis solve take.trc --actor face.zip --plain --csv --standard-errors",
            "frontalis watch take-1 --every-frame --csv --standard-errors",
            "frontalis simulate --actor reference --session take-1 --rate 60 --seconds 10 --cameras 5 --pixel-noise 0.3 --misses 0.03 --seed 7 --truth truth.csv",
            "frontalis demo --seconds 10",
            "frontalis login --server https://stage:7400 --ca-cert ca.pem",
            "frontalis logout --all",
            "frontalis server --json --token-file token",
            "frontalis status --client-cert me.pem --client-key me.key",
            "frontalis token create --token-file tokens.toml --name StageA --role publisher --sessions stage-a-*,desk-1 --expires 90d",
            "frontalis token create --token-file tokens.toml --name Anna --role operator --images",
            "frontalis token list --token-file tokens.toml --json",
            "frontalis token revoke t-5f0c2a91 --token-file tokens.toml --yes",
            "frontalis audit verify /var/lib/frontalis/audit.log --json",
            "frontalis completions bash",
        ] {
            if let Err(error) = parse(line) {
                panic!("{line}: {error}");
            }
        }
    }

    #[test]
    fn figures_outside_their_range_are_usage_errors() {
        for line in [
            "frontalis session create --actor anna --id=",
            "frontalis session create --actor anna --id sessions/",
            "frontalis actor import face.zip --id=",
            "frontalis session create --actor anna --stale-after-millis 9",
            "frontalis session create --actor anna --stale-after-millis 3600001",
            "frontalis session update take-1 --publisher-timeout-secs 0",
            "frontalis session update take-1 --publisher-timeout-secs 3601",
            "frontalis session create --actor anna --neutral-frames 0",
            "frontalis session create --actor anna --neutral-frames 257",
            "frontalis session create --actor anna --smoothing 2",
            "frontalis session update take-1 --bounds jaw=1..0",
            "frontalis simulate --session s --rate 0",
            "frontalis simulate --session s --rate nan",
            "frontalis simulate --session s --misses 1.5",
            "frontalis simulate --session s --cameras 1",
            "frontalis watch take-1 --from-start",
            "frontalis watch take-1 --csv",
            "frontalis token list",
            "frontalis token create --token-file f --name n --role admin",
            "frontalis token create --token-file f --name n --role viewer --sessions A/B",
            "frontalis token create --token-file f --name n --role operator --expires tomorrow",
        ] {
            let error = parse(line).expect_err(line);
            assert_eq!(error.exit_code(), 2, "{line}");
        }
    }
}
