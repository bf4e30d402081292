//! Records the compiler and the target, which a report of run times must name.

use std::env;
use std::process::Command;

fn main() {
    let compiler = env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let version = Command::new(compiler).arg("--version").output().ok();
    let version = version.and_then(|output| String::from_utf8(output.stdout).ok()).unwrap_or_default();
    let version = if version.trim().is_empty() { "unknown" } else { version.trim() };
    let setting = |name| env::var(name).unwrap_or_else(|_| "unknown".into());
    println!("cargo::rustc-env=RATIOCV_COMPILER={version}");
    println!("cargo::rustc-env=RATIOCV_TARGET={}", setting("TARGET"));
    println!("cargo::rustc-env=RATIOCV_PROFILE=opt-level {}", setting("OPT_LEVEL"));
    println!("cargo::rerun-if-changed=build.rs");
}
