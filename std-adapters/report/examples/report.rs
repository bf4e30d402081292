//! Measures everything and writes the page: `cargo run --release -p ratiocv-report --example report -- DIR [quick]`.

use ratiocv_report::{Options, TableOptions, run};
use std::path::Path;

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let dir = arguments.next().unwrap_or_else(|| "report".into());
    let options = Options { quick: arguments.next().is_some_and(|word| word == "quick"), ..Options::default() };
    let report = run(&options, &())?;
    print!("{}", report.table(TableOptions::default()));
    for path in report.write(Path::new(&dir))? {
        println!("{}", path.display());
    }
    Ok(())
}
