//! `ratiocv list`: what there is to choose from.

use crate::fault::Fault;
use ratiocv_report::catalogue::Method;
use ratiocv_report::problems::Problem;
use ratiocv_scene::BuiltIn;
use std::io::Write;

/// Prints the problems, the scenes and the estimators, one line each.
///
/// # Errors
/// Those of writing.
pub fn run(out: &mut dyn Write) -> Result<(), Fault> {
    let estimators: Vec<_> = Method::all().map(|method| (method.id().to_owned(), method.about().to_owned())).collect();
    let problems: Vec<_> =
        Problem::all().map(|problem| (problem.id().to_owned(), problem.about().to_owned())).collect();
    let scenes: Vec<_> = BuiltIn::ALL.iter().map(|scene| (scene.name.to_owned(), scene.about.to_owned())).collect();
    let pixels: Vec<_> =
        ratiocv_scene::Method::all().map(|method| (method.name().to_owned(), method.summary().to_owned())).collect();
    print("Problems", &problems, out)?;
    writeln!(out)?;
    print("Estimators", &estimators, out)?;
    writeln!(out)?;
    print("Scenes", &scenes, out)?;
    writeln!(out)?;
    print("Estimators of pixels", &pixels, out)?;
    Ok(out.flush()?)
}

fn print(title: &str, lines: &[(String, String)], out: &mut dyn Write) -> Result<(), Fault> {
    let width = lines.iter().map(|(id, _)| id.chars().count()).max().unwrap_or(0);
    writeln!(out, "{title}:")?;
    for (id, about) in lines {
        writeln!(out, "  {id:width$}  {about}")?;
    }
    Ok(())
}
