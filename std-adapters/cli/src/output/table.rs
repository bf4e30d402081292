//! A table to read on a terminal, and the verdict in words.

use crate::flag_help::meaning;
use crate::output::number::significant;
use crate::verdict::{Line, Verdict};
use crate::words::{counted, listed, rows};
use comfy_table::{Cell, CellAlignment, LineStyle, Table, TableStyle};
use ratiocv_core::Flags;
use ratiocv_report::catalogue::Method;
use std::io::{self, Write};

pub(super) fn print(verdict: &Verdict, out: &mut dyn Write) -> io::Result<()> {
    write!(out, "{} from {}", counted(verdict.draws, "draw"), verdict.file)?;
    match verdict.skipped {
        0 => writeln!(out)?,
        skipped => writeln!(out, "; {} skipped", rows(skipped))?,
    }
    print_integrals(verdict, out)?;
    writeln!(out, "{}", table(verdict))?;
    print_favoured(verdict, out)?;
    print_flags(verdict, out)
}

fn print_integrals(verdict: &Verdict, out: &mut dyn Write) -> io::Result<()> {
    if verdict.estimates.iter().all(|line| line.auxiliary.is_none()) {
        return Ok(());
    }
    let given = verdict.integrals.iter().filter(|known| !known.assumed);
    let given: Vec<_> = given.map(|known| format!("{} = {}", known.column, known.value)).collect();
    if !given.is_empty() {
        writeln!(out, "known integrals: {}", given.join(", "))?;
    }
    let assumed = verdict.assumed();
    if !assumed.is_empty() {
        let list = listed(&assumed);
        writeln!(out, "known integrals taken to be 1, since no --integral was given: {list}")?;
    }
    if verdict.estimates.iter().any(|line| line.method.is_defensive()) {
        writeln!(out, "defensive auxiliaries: {w} H + (1 - {w}) h", w = verdict.weight)?;
    }
    Ok(())
}

fn table(verdict: &Verdict) -> Table {
    let mut table = Table::new();
    table.load_style(TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─')));
    table.set_header(["channel", "estimator", "auxiliary", "value", "std error", "predicted RMSE", "flags"]);
    for line in &verdict.estimates {
        let Line { estimate, .. } = line;
        let number = |value, digits| Cell::new(significant(value, digits)).set_alignment(CellAlignment::Right);
        table.add_row([
            Cell::new(&verdict.channels[line.channel]),
            Cell::new(line.method.id()),
            Cell::new(line.auxiliary.as_deref().unwrap_or("-")),
            number(estimate.value, 7),
            number(estimate.std_error, 3),
            number(line.predicted_mse.sqrt(), 3),
            Cell::new(estimate.flags),
        ]);
    }
    table
}

fn print_favoured(verdict: &Verdict, out: &mut dyn Write) -> io::Result<()> {
    let draws = counted(verdict.draws, "draw");
    writeln!(
        out,
        "\nLeast predicted RMSE of a consistent estimator at {draws} (predicted from these same draws: a guide, not a promise):"
    )?;
    for (channel, name) in verdict.channels.iter().enumerate() {
        let Some(best) = verdict.favoured(channel) else {
            writeln!(out, "  {name}: no prediction holds; draw more")?;
            continue;
        };
        write!(out, "  {name}: {}{}", told(best), compared(verdict, best))?;
        match verdict.favoured_unbiased(channel) {
            Some(unbiased) if unbiased != best => writeln!(out, "; of the unbiased, {}", told(unbiased))?,
            Some(_) => writeln!(out, "; it is unbiased")?,
            None => writeln!(out)?,
        }
    }
    if verdict.estimates.iter().any(|line| !line.is_eligible()) {
        writeln!(
            out,
            "  (left aside: estimators that fell back, whose denominator is ill, or whose H the draws contradict)"
        )?;
    }
    Ok(())
}

fn told(line: &Line) -> String {
    let on = line.auxiliary.as_deref().map_or_else(String::new, |auxiliary| format!(" on {auxiliary}"));
    format!("{}{on}, {}", line.method.id(), significant(line.predicted_mse.sqrt(), 3))
}

/// How much better than plain Monte Carlo.
fn compared(verdict: &Verdict, best: &Line) -> String {
    let plain = verdict.estimates.iter().find(|line| line.channel == best.channel && line.method == Method::PLAIN);
    let gain = plain.map_or(f64::NAN, |plain| (plain.predicted_mse / best.predicted_mse).sqrt());
    if best.method == Method::PLAIN || !gain.is_finite() {
        String::new()
    } else {
        format!(" ({}x less than mc)", significant(gain, 3))
    }
}

fn print_flags(verdict: &Verdict, out: &mut dyn Write) -> io::Result<()> {
    let raised = verdict.estimates.iter().fold(Flags::NONE, |raised, line| raised | line.estimate.flags);
    if raised.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nFlags:")?;
    for (flag, name) in Flags::ALL.iter().filter(|(flag, _)| raised.contains(*flag)) {
        writeln!(out, "  {name}: {}", meaning(*flag))?;
    }
    Ok(())
}
