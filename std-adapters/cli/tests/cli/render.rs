//! Scenes become images.

use crate::support::{Run, fails_with, file, ratiocv};
use std::path::PathBuf;

fn path(name: &str) -> String {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name).to_str().expect("a path").to_owned()
}

fn render(arguments: &[&str]) -> Run {
    ratiocv(&[&["render"], arguments].concat(), "")
}

/// A small scene, with `change` made to its text.
fn scene(name: &str, change: impl Fn(&str) -> String) -> String {
    let xml = ratiocv_scene::BuiltIn::named("S4b").expect("a scene").xml.replace("128", "8");
    file(name, change(&xml).as_bytes()).to_str().expect("a path").to_owned()
}

#[test]
fn a_scene_becomes_images_of_every_kind() {
    let (exr, png) = (path("a.exr"), path("a.png"));
    let scene = scene("a.xml", str::to_owned);
    let run = render(&[&scene, "--spp", "16", "--layer", "error", "--layer", "flags", "--out", &exr, "--out", &png]);
    assert_eq!((run.code, run.err.as_str()), (0, ""), "{run:?}");
    for name in ["a.exr", "a.png", "a-error.exr", "a-error.png", "a-flags.exr", "a-flags.png"] {
        assert!(run.out.contains(&format!("wrote {}\n", path(name))), "{name} in {}", run.out);
        assert!(std::fs::metadata(path(name)).expect("a file").len() > 50);
    }
    assert!(run.out.contains("8 x 8 pixels, 0.001 M samples in ") && run.out.contains(" M samples/s\n"), "{}", run.out);
}

#[test]
fn what_is_left_out_is_explained() {
    let run = render(&["s4a", "--explain"]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    for line in ["three channels", "auxiliaries", "media: none", "conductors"] {
        assert!(run.out.contains(line), "{line} in {}", run.out);
    }
    // A file of a built-in scene's name comes first.
    assert!(!render(&["S3", "--explain"]).out.contains("media: none"));
}

#[test]
fn a_render_goes_on_where_it_was_saved() {
    let (scene, saved, out) = (scene("b.xml", str::to_owned), path("b.ratiocv"), path("b.exr"));
    let run = render(&[&scene, "--spp", "64", "--save", &saved, "--out", &out]);
    assert_eq!(run.code, 0, "{run:?}");
    let run = render(&[&scene, "--spp", "128", "--resume", &saved, "--save", &saved, "--out", &out]);
    assert!(run.code == 0 && run.out.contains("0.004 M samples in"), "64 pixels, 64 more samples each: {run:?}");
    let other = render(&[&scene, "--spp", "128", "--resume", &saved, "--seed", "1", "--out", &out]);
    fails_with(&other, 1, &["the seed is 1 here and 0 in the file", "b.ratiocv"]);
    fails_with(&render(&[&scene, "--resume", &path("none"), "--out", &out]), 1, &["none", "cannot read it"]);
    let second = path("b2.ratiocv");
    assert_eq!(render(&[&scene, "--spp", "64", "--seed", "2", "--save", &second, "--out", &out]).code, 0);
    let run = render(&[&scene, "--spp", "192", "--resume", &saved, "--merge", &format!("{second}:2"), "--out", &out]);
    assert!(run.code == 0 && run.out.contains("0.000 M samples in"), "128 and 64 samples: {run:?}");
    fails_with(&render(&[&scene, "--merge", "b2.ratiocv", "--out", &out]), 2, &["--merge", "a.ratiocv:2"]);
    // The image is worth more than the file that it should have been kept in.
    let run = render(&[&scene, "--save", "/nowhere/at/all", "--out", &out]);
    assert!(run.code == 1 && run.out.contains("wrote ") && run.err.contains("/nowhere/at/all"), "{run:?}");
}

#[test]
fn times_and_errors_are_budgets() {
    let (scene, out) = (scene("c.xml", str::to_owned), path("c.png"));
    for budget in [["--time", "0.05"], ["--error", "0.1"], ["--spp", "3"]] {
        assert_eq!(render(&[&[scene.as_str(), "--out", &out], &budget[..]].concat()).code, 0, "{budget:?}");
    }
    fails_with(&render(&[&scene, "--out", &out, "--spp", "3", "--time", "1"]), 2, &["--spp", "--time"]);
    for (option, value) in
        [("--time", "0"), ("--error", "-1"), ("--error", "NaN"), ("--spp", "0"), ("--defensive", "1")]
    {
        fails_with(&render(&[&scene, "--out", &out, option, value]), 2, &[option]);
    }
}

#[test]
fn every_estimator_has_a_name() {
    let (scene, out) = (scene("d.xml", str::to_owned), path("d.png"));
    for method in ratiocv_scene::Method::all() {
        assert_eq!(render(&[&scene, "--spp", "4", "--estimator", method.name(), "--out", &out]).code, 0, "{method:?}");
    }
    assert_eq!(render(&[&scene, "--spp", "4", "--estimator", "plain", "--out", &out]).code, 0);
    fails_with(&render(&[&scene, "--estimator", "rato", "--out", &out]), 2, &["ratio"]);
}

#[test]
fn bad_scenes_and_names_are_errors_that_say_where() {
    let out = path("e.png");
    fails_with(&render(&["S9", "--out", &out]), 1, &["S9: cannot be read", "give a scene file"]);
    let broken = scene("broken.xml", |xml| xml.replacen("</scene>", "", 1));
    fails_with(&render(&[&broken, "--out", &out]), 1, &["broken.xml", "correct the scene file"]);
    let unknown = scene("unknown.xml", |xml| xml.replacen("type=\"diffuse\"", "type=\"plastic\"", 1));
    fails_with(&render(&[&unknown, "--out", &out]), 1, &["unknown.xml, line ", "plastic", "diffuse", "--lenient"]);
    let run = render(&[&unknown, "--lenient", "--spp", "1", "--out", &out]);
    assert!(run.code == 0 && run.err.starts_with("warning: ") && run.err.contains("plastic"), "{run:?}");
    let dark = scene("dark.xml", |xml| xml.replace("1, 0.5, 2", "0, 0, 0").replace("1 0.5 2", "0 0 0"));
    fails_with(&render(&[&dark, "--out", &out]), 1, &["light"]);
    let scene = scene("f.xml", str::to_owned);
    fails_with(&render(&[&scene, "--out", "image.jpeg"]), 2, &["image.jpeg", ".exr or .png"]);
    fails_with(&render(&[&scene, "--out", "/nowhere/at/all.png"]), 1, &["/nowhere/at/all.png", "folder /nowhere/at"]);
    fails_with(&render(&[&scene]), 2, &["--out"]);
}

#[test]
fn a_black_image_is_said_to_be_one() {
    // A light that looks away.
    let scene = file(
        "black.xml",
        br#"<scene version="3.0.0">
            <integrator type="path"><integer name="max_depth" value="2"/></integrator>
            <sensor type="perspective">
                <float name="fov" value="40"/>
                <transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
                <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
                    <rfilter type="box"/></film>
                <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
            </sensor>
            <shape type="rectangle">
                <transform name="to_world"><rotate y="1" angle="180"/><translate z="-3"/></transform>
                <bsdf type="diffuse"/>
                <emitter type="area"><rgb name="radiance" value="1, 1, 1"/></emitter>
            </shape>
        </scene>"#,
    );
    let run = render(&[scene.to_str().expect("a path"), "--out", &path("black.png")]);
    assert!(run.code == 0 && run.out.contains("every pixel is black"), "{run:?}");
}
