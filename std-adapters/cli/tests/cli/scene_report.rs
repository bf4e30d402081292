//! `report --scene`.

use crate::support::{fails_with, file, ratiocv};
use std::path::PathBuf;

#[test]
fn a_scene_is_rendered_by_every_method() {
    let xml = ratiocv_scene::BuiltIn::named("S1").expect("a scene").xml.replace("128", "8");
    let scene = file("report.xml", xml.as_bytes());
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("scene report");
    let _ = std::fs::remove_dir_all(&folder);
    let arguments =
        ["report", "--quick", "--scene", scene.to_str().expect("a path"), "--out", folder.to_str().expect("a path")];
    let run = ratiocv(&arguments, "");
    assert_eq!((run.code, run.err.as_str()), (0, ""), "{run:?}");
    for name in ["scene.html", "scene.csv", "scene.json", "image-reference.png", "error-mc.png"] {
        let path = folder.join(name);
        assert!(run.out.contains(&format!("wrote {}\n", path.display())), "{name} in {}", run.out);
        assert!(std::fs::metadata(path).expect("a file").len() > 50);
    }
    let csv = std::fs::read_to_string(folder.join("scene.csv")).expect("a file");
    assert_eq!(csv.lines().count(), 1 + 4 * ratiocv_scene::Method::all().count());
    let json: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(folder.join("scene.json")).expect("a file")).expect("JSON");
    let point = |estimator: &str| {
        let points = json["points"].as_array().expect("points");
        let wanted = |point: &&serde_json::Value| point["estimator"] == estimator && point["samples"] == 64;
        points.iter().find(wanted).expect("a point")["gain"].as_f64().expect("a gain")
    };
    // Coloured lights, 64 samples: 3.7 times less squared error in pixels as large as these, on any machine.
    assert!(point("defensive_ratio") > 3.0 && (point("mc") - 1.0).abs() < 1e-12, "{}", point("defensive_ratio"));
    // The reference is kept, and the same errors are measured again.
    let references = || {
        std::fs::read_dir(&folder).expect("a folder").filter(|entry| {
            entry.as_ref().is_ok_and(|entry| entry.file_name().to_string_lossy().starts_with("reference-"))
        })
    };
    assert_eq!(references().count(), 1);
    assert_eq!(ratiocv(&arguments, "").code, 0);
    let again = std::fs::read_to_string(folder.join("scene.csv")).expect("a file");
    let errors = |csv: &str| -> Vec<String> {
        csv.lines().map(|line| line.split(',').take(7).collect::<Vec<_>>().join(",")).collect()
    };
    assert_eq!(errors(&csv), errors(&again));
    fails_with(&ratiocv(&["report", "--scene", "S9", "--out", folder.to_str().expect("a path")], ""), 1, &["S9"]);
    fails_with(&ratiocv(&["report", "--lights", "power"], ""), 2, &["--scene"]);
}
