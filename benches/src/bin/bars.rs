//! Measures all contenders in turn, round after round, so that noise hits all alike, and prints the table of
//! `benches/README.md`: `bars [--rounds N] [--draws N] [--check]`. With `--check` a bar that does not hold
//! makes it fail.

use ratiocv_benches::bars::{BARS, Build, Demand};
use ratiocv_benches::{Measured, clock, sets};
use std::process::{Command, ExitCode};
use std::time::Instant;

/// Seconds of one contender in one round.
const SLICE: f64 = 1e-4;

/// A contender and its seconds per sample and channel, round by round.
struct Timed {
    contender: Measured,
    passes: u32,
    seconds: Vec<f64>,
}

impl Timed {
    fn new(mut contender: Measured) -> Self {
        let mut passes = 1;
        while seconds(passes, || contender.pass()) < SLICE {
            passes *= 2;
        }
        Self { contender, passes, seconds: Vec::new() }
    }

    fn round(&mut self) {
        let seconds = seconds(self.passes, || self.contender.pass());
        self.seconds.push(seconds / f64::from(self.passes) / self.contender.samples as f64);
    }
}

/// Seconds that `passes` calls take.
fn seconds(passes: u32, mut pass: impl FnMut()) -> f64 {
    let start = Instant::now();
    for _ in 0..passes {
        pass();
    }
    start.elapsed().as_secs_f64()
}

/// The median of a/b over the rounds.
fn median_ratio(a: &[f64], b: &[f64]) -> f64 {
    let mut ratios: Vec<f64> = a.iter().zip(b).map(|(a, b)| a / b).collect();
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() / 2]
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let option = |name: &str, default| match arguments.iter().position(|argument| argument == name) {
        None => default,
        Some(i) => arguments.get(i + 1).and_then(|n| n.parse().ok()).unwrap_or_else(|| panic!("{name} takes a number")),
    };
    let (rounds, draws) = (option("--rounds", 400), option("--draws", sets::IN_L1));

    let mut timed: Vec<Timed> = sets::all(draws).into_iter().map(Timed::new).collect();
    let mut cycle = Vec::new();
    for _ in 0..rounds.max(1) {
        let passes = 256;
        let mut known = true;
        let seconds = seconds(passes, || known &= clock::pass());
        cycle.push(if known { seconds / f64::from(passes) / clock::CYCLES } else { f64::NAN });
        timed.iter_mut().for_each(Timed::round);
    }

    heading(draws, rounds, &cycle);
    kernels(&timed, &cycle);
    if bars(&timed) || !arguments.iter().any(|argument| argument == "--check") {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}

/// Where, with what, and how.
fn heading(draws: usize, rounds: usize, cycle: &[f64]) {
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cpu = cpuinfo.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    let family = |key: &str| {
        let line = cpuinfo.lines().find(|line| line.split(':').next().is_some_and(|name| name.trim() == key));
        line.and_then(|line| line.split(':').nth(1)).unwrap_or("?").trim()
    };
    let compiler = Command::new("rustc").arg("--version").output().ok();
    let compiler = compiler.and_then(|output| String::from_utf8(output.stdout).ok()).unwrap_or_default();
    let flags = match Build::THIS.flag() {
        "" => String::new(),
        flag => format!("RUSTFLAGS=\"{flag}\" "),
    };
    println!("`{flags}cargo run --release -p ratiocv-benches --bin bars -- --draws {draws} --rounds {rounds}`\n");
    println!(
        "{} (family {}, model {}), {:.2} GHz by a loop of known latency; {}; {:?} build.\n",
        cpu.map_or(std::env::consts::ARCH, |(_, name)| name.trim()),
        family("cpu family"),
        family("model"),
        1e-9 / median_ratio(cycle, &vec![1.0; cycle.len()]),
        compiler.trim(),
        Build::THIS
    );
}

/// The time of each, per sample and channel.
fn kernels(timed: &[Timed], cycle: &[f64]) {
    println!("| kernel | ns | cycles |\n|---|---|---|");
    for one in timed {
        let nanoseconds = 1e9 * median_ratio(&one.seconds, &vec![1.0; one.seconds.len()]);
        println!("| {} | {nanoseconds:.3} | {:.2} |", one.contender.name(), median_ratio(&one.seconds, cycle));
    }
    println!();
}

/// Ours beside the others of its set and beside the rivals of its bars; whether all bars hold.
fn bars(timed: &[Timed]) -> bool {
    println!("| ours | rival | measured | bar | holds |\n|---|---|---|---|---|");
    let mut all_hold = true;
    for ours in timed.iter().filter(|one| is_ours(one)) {
        let set = ours.contender.set;
        let bar_of = |rival: &str| BARS.iter().find(|bar| bar.is_between(set, &ours.contender.id, rival));
        let in_set = timed.iter().filter(|one| one.contender.set == set && !is_ours(one));
        let elsewhere = timed.iter().filter(|one| one.contender.set != set && bar_of(&one.contender.name()).is_some());
        for rival in in_set.chain(elsewhere) {
            let name = rival.contender.name();
            let ratio = median_ratio(&ours.seconds, &rival.seconds);
            let bar = bar_of(&name).filter(|bar| bar.asks(&ours.contender.id));
            let holds = bar.map(|bar| bar.demand.met_by(ratio));
            all_hold &= holds != Some(false);
            let faster = bar.map_or(ratio < 1.0, |bar| matches!(bar.demand, Demand::Faster(_)));
            println!(
                "| {} | {name} | {} | {} | {} |",
                ours.contender.name(),
                if faster { format!("{:.2} × faster", 1.0 / ratio) } else { format!("{ratio:.2} × its time") },
                bar.map(|bar| bar.demand.to_string()).unwrap_or_default(),
                holds.map_or("", |holds| if holds { "yes" } else { "**no**" }),
            );
        }
    }
    all_hold
}

fn is_ours(one: &Timed) -> bool {
    one.contender.id.starts_with("ours")
}
