# One command for each thing a person does with this repository; `make check` is exactly what CI runs.

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
.DELETE_ON_ERROR:

# The data bundle that some tests read; they say by name that they were left out when it is not there.
FRONTALIS_DATA ?= $(abspath ../shared/data)
export FRONTALIS_DATA

# 0: until Ctrl-C.
DEMO_SECONDS ?= 0
NEXTEST_VERSION := 0.9.151
CHURN_SECONDS ?= 600
# Where the demo listens.
DEMO_LISTEN ?= 127.0.0.1:7400

.PHONY: help
help: ## This list
	@awk 'BEGIN {FS = ":.*## "} /^[a-z-]+:.*## / {printf "  make %-12s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

.PHONY: demo
demo: ## Build (release), start a server and a simulated stage, show the curves; DEMO_SECONDS=10 ends by itself
	cargo build --release --bin frontalis --bin frontalis-server
	@exec target/release/frontalis demo --listen $(DEMO_LISTEN) --data-dir ./demo-data --seconds $(DEMO_SECONDS)

.PHONY: clean-demo
clean-demo: ## Forget what the demo stored
	rm -rf ./demo-data

.PHONY: test
test: clients runner ## Every test there is; ends with the runner's own count
	cargo build --workspace --bins --tests --quiet
	cargo test --workspace --doc --quiet
	@if ! cargo nextest --version >/dev/null 2>&1; then \
	  cargo test --workspace --lib --bins --tests --no-fail-fast; \
	elif [ -d "$(FRONTALIS_DATA)" ]; then \
	  cargo nextest run --workspace; \
	else \
	  cargo nextest run --workspace --profile without-data 2>&1 | awk -f .ci/left-out.awk; \
	fi

# The runner is installed once a machine; without it (no network), cargo's own runner does the work.
.PHONY: runner
runner:
	@cargo nextest --version >/dev/null 2>&1 \
	  || cargo install --locked --quiet cargo-nextest --version $(NEXTEST_VERSION) \
	  || echo "cargo-nextest could not be installed: cargo test runs the tests, one count a binary"

# What the clients of tests/clients need; their tests are left out by name when it cannot be had.
.PHONY: clients
clients: python node schemathesis-program

# Read by the clients of tests/clients when a person runs them.
.PHONY: client-files
client-files: ## An actor and a take for the clients of tests/clients, in ./client-files
	cargo run --quiet --package frontalis-tests --bin client-files -- client-files

.PHONY: python
python:
	@$(MAKE) --no-print-directory .venv/ready \
	  || echo "left out: clients::python_over_grpc: python3 with venv and pip is needed to make .venv"

.venv/ready: tests/clients/python/requirements.txt
	@python3 -m venv .venv
	@.venv/bin/pip install --quiet --disable-pip-version-check --requirement $<
	@touch $@

.PHONY: schemathesis-program
schemathesis-program:
	@$(MAKE) --no-print-directory .venv-schemathesis/ready \
	  || echo "left out: openapi::schemathesis: python3 with venv and pip is needed to make .venv-schemathesis"

.venv-schemathesis/ready: tests/clients/schemathesis/requirements.txt
	@python3 -m venv .venv-schemathesis
	@.venv-schemathesis/bin/pip install --quiet --disable-pip-version-check --requirement $<
	@touch $@

# Many more cases than the test has, against the same server.
SCHEMATHESIS_EXAMPLES ?= 400
.PHONY: schemathesis
schemathesis: schemathesis-program ## Every check of schemathesis on /openapi.json, for longer than the test does
	FRONTALIS_SCHEMATHESIS_EXAMPLES=$(SCHEMATHESIS_EXAMPLES) \
	  cargo test --package frontalis-tests --test end_to_end -- --nocapture openapi::schemathesis_finds_nothing

.PHONY: node
node:
	@$(MAKE) --no-print-directory tests/clients/typescript/node_modules/ready \
	  || echo "left out: clients::typescript: Node 20 with npm is needed to make node_modules"

tests/clients/typescript/node_modules/ready: tests/clients/typescript/package-lock.json
	@node --version | grep -qE '^v(2[0-9]|[3-9][0-9])' && cd $(<D) && npm ci --silent --no-audit --no-fund
	@touch $@

.PHONY: check
check: fmt clippy doc deny-if-installed test ## Formatting, clippy, rustdoc, supply chain and tests: what CI runs

.PHONY: fmt
fmt: ## Formatting
	cargo fmt --all -- --check

.PHONY: clippy
clippy: ## Lints, warnings denied
	cargo clippy --workspace --all-targets -- -D warnings

.PHONY: doc
doc: ## Documentation, warnings denied
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --document-private-items

.PHONY: deny
deny: ## Licences, sources and advisories of every dependency, against the pinned snapshot, without a network
	@cargo deny --version >/dev/null 2>&1 || cargo install --locked cargo-deny
	@.ci/deny

# Installing cargo-deny costs a cold machine more minutes than the whole build, so CI runs it where it is.
.PHONY: deny-if-installed
deny-if-installed:
	@if cargo deny --version >/dev/null 2>&1; then .ci/deny; \
	else echo "left out: supply chain (make deny): cargo-deny is not installed"; fi

# Longer than the tests: each target for FUZZ_SECONDS, on a nightly toolchain; what breaks is kept in fuzz/artifacts.
FUZZ_SECONDS ?= 60
FUZZ_TARGETS := marker_frames c3d trc
.PHONY: fuzz
fuzz: ## Every fuzz target for FUZZ_SECONDS (a minute); needs the nightly toolchain
	@cargo +nightly fuzz --version >/dev/null 2>&1 || cargo +nightly install --locked cargo-fuzz
	@for target in $(FUZZ_TARGETS); do \
	  cargo +nightly fuzz run $$target -- -max_total_time=$(FUZZ_SECONDS) -rss_limit_mb=2048 || exit 1; \
	done

.PHONY: bench
bench: ## CPU time of the solve, the stage and the alignment, one thread
	cargo bench --workspace --bench "*"

.PHONY: bench-load
bench-load: ## 64 sessions at 120 Hz with a subscriber each, 30 s: losses and latency
	cargo run --release --package frontalis-tests --bin load

.PHONY: accuracy
accuracy: scipy ## Errors beside those of other methods where the truth is known: writes docs/accuracy.md and its pictures
	cargo run --release --package frontalis-tests --bin accuracy

.PHONY: scipy
scipy:
	@$(MAKE) --no-print-directory .venv-accuracy/ready \
	  || echo "left out: scipy: python3 with venv and pip is needed to make .venv-accuracy"

.venv-accuracy/ready: tests/accuracy/requirements.txt
	@python3 -m venv .venv-accuracy
	@.venv-accuracy/bin/pip install --quiet --disable-pip-version-check --requirement $<
	@touch $@

.PHONY: churn
churn: ## Sessions made, used and ended for CHURN_SECONDS (ten minutes): memory, files and disk stay flat
	FRONTALIS_CHURN_SECONDS=$(CHURN_SECONDS) cargo test --package frontalis-tests --test end_to_end -- --nocapture i8_

.PHONY: bench-late
bench-late: ## A renderer that sleeps 20 s at 120 Hz: what it gets when it wakes
	cargo run --release --package frontalis-tests --bin late

.PHONY: bench-abuse
bench-abuse: ## What abuse of HTTP/2 and of connections costs the server: the figures of docs/reliability.md
	cargo build --workspace --bins --tests --quiet
	@cargo test --package frontalis-tests --test end_to_end -- --nocapture --test-threads 1 \
	  bad_input::http2 bad_input::connections bad_input::tls | grep --extended-regexp 'G12|F[0-9]+|test result'

# Simulations of make simulations.
SEEDS ?= 200
.PHONY: simulations
simulations: ## Publisher, server and subscriber under SEEDS (200) schedules of faults in simulated time, and every state of two publishers (G6, G7)
	@FRONTALIS_SIMULATIONS=$(SEEDS) cargo test --package frontalis-tests --test end_to_end -- --nocapture simulation::every \
	  | grep --extended-regexp 'simulations,|test result|seed'
	@cargo test --package frontalis-server --lib -- --nocapture --test-threads 1 intake::model \
	  | grep --extended-regexp 'states|after|test result'

# Each writes its section of docs/reliability.md.
RUNS ?= 200
CYCLES ?= 100
TAKES_SECONDS ?= 30
RELIABILITY := target/release/reliability
.PHONY: kill-test drain-test bench-recovery bench-takes bench-resolve
kill-test: release-server ## A recording server killed RUNS (200) times: no acknowledged frame is lost
	$(RELIABILITY) kill $(RUNS)

drain-test: release-server ## A recording server drained and started again CYCLES (100) times
	$(RELIABILITY) drain $(CYCLES)

bench-recovery: release-server ## 100,000 takes, 10,000 of them open, and one of a million frames: when the server is ready
	$(RELIABILITY) recovery

bench-takes: release-server ## 64 sessions recorded at 120 Hz: what is shed, how far stable storage is behind, bytes a frame
	$(RELIABILITY) takes $(TAKES_SECONDS)

RESOLVE_MINUTES ?= 10
bench-resolve: ## A take of 10 min of 27 markers at 120 Hz solved again, plain and by default: processor time of one core
	$(RELIABILITY) resolve $(RESOLVE_MINUTES)

# Together, so that both have the same dependencies.
.PHONY: release-server
release-server:
	cargo build --release --package frontalis-server --package frontalis-tests --bin frontalis-server --bin reliability

.PHONY: bench-doors
bench-doors: ## Processor time of a delivered sample at each door beside plain TCP, and what clients that do not read cost
	cargo build --release --bin frontalis-server
	cargo run --release --package frontalis-tests --bin doors
