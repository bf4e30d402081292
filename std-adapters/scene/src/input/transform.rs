//! `<transform>`: its operations, each applied after those before it. All is `f64` until the whole is known.

use super::element::Element;
use super::error::Error;
use crate::planted::planted;
use glam::{Affine3A, DAffine3, DMat3, DVec3, Vec3};

/// Axes of a transform shorter or longer than this leave nothing of `f32`.
const SHORTEST: f64 = 1e-12;
const LONGEST: f64 = 1e12;

/// The product of the operations in `element`.
pub(super) fn read(element: Element<'_>) -> Result<DAffine3, Error> {
    element.only_attributes(&["name"])?;
    let mut whole = DAffine3::IDENTITY;
    for operation in element.children() {
        let next = read_operation(operation)?;
        whole = planted!("transform_order": next * whole, whole * next);
    }
    if !whole.is_finite() {
        return Err(element.invalid("its product is not finite"));
    }
    element.pass_over();
    Ok(whole)
}

fn read_operation(operation: Element<'_>) -> Result<DAffine3, Error> {
    match operation.tag() {
        "translate" => {
            operation.only_attributes(&["value", "x", "y", "z"])?;
            Ok(DAffine3::from_translation(triple(operation, Some(0.0))?))
        }
        "scale" => {
            operation.only_attributes(&["value", "x", "y", "z"])?;
            Ok(DAffine3::from_scale(triple(operation, Some(1.0))?))
        }
        "rotate" => rotate(operation),
        "lookat" => look_at(operation),
        "matrix" => matrix(operation),
        _ => Err(operation.unsupported_type("translate, scale, rotate, lookat, matrix")),
    }
}

/// Three numbers by `value`, or by `x`, `y` and `z`, of which those not given are `default`.
pub(super) fn triple(element: Element<'_>, default: Option<f64>) -> Result<DVec3, Error> {
    let mut axes = [None; 3];
    for (axis, name) in axes.iter_mut().zip(["x", "y", "z"]) {
        *axis = element.attribute(name)?.map(|text| element.number(&text)).transpose()?;
    }
    if let Some(value) = element.attribute("value")? {
        if axes.iter().any(Option::is_some) {
            return Err(element.invalid("has both value and x, y, z; give one of them"));
        }
        return element.vector(&value);
    }
    match axes.map(|axis| axis.or(default)) {
        [Some(x), Some(y), Some(z)] => Ok(DVec3::new(x, y, z)),
        _ => Err(element.invalid("needs x, y and z")),
    }
}

/// Counterclockwise by `angle` degrees, seen from the tip of the axis (Rodrigues).
fn rotate(operation: Element<'_>) -> Result<DAffine3, Error> {
    operation.only_attributes(&["value", "x", "y", "z", "angle"])?;
    let axis = triple(operation, Some(0.0))?;
    let angle = operation.number(&operation.required("angle")?)?;
    // Mitsuba does not normalise the axis, and shears with any other.
    if (axis.length() - 1.0).abs() > 1e-4 {
        return Err(operation.invalid(format!("the axis ({}, {}, {}) must have length 1", axis.x, axis.y, axis.z)));
    }
    let (sin, cos) = sine_and_cosine(angle);
    let column = |e: DVec3| {
        e * cos + planted!("rotation_sense": axis.cross(e), e.cross(axis)) * sin + axis * (axis.dot(e) * (1.0 - cos))
    };
    Ok(DAffine3::from_mat3(DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))))
}

/// Of an angle in degrees; exact for quarter turns, so that floors are level.
fn sine_and_cosine(degrees: f64) -> (f64, f64) {
    match degrees % 360.0 {
        0.0 => (0.0, 1.0),
        90.0 | -270.0 => (1.0, 0.0),
        180.0 | -180.0 => (0.0, -1.0),
        270.0 | -90.0 => (-1.0, 0.0),
        other => (libm::sin(other.to_radians()), libm::cos(other.to_radians())),
    }
}

/// z towards `target`, y as far as possible along `up`, x to the left.
fn look_at(operation: Element<'_>) -> Result<DAffine3, Error> {
    operation.only_attributes(&["origin", "target", "up"])?;
    let point = |name| operation.vector(&operation.required(name)?);
    let (origin, target, up) = (point("origin")?, point("target")?, point("up")?);
    let ahead = (target - origin).try_normalize();
    let ahead = ahead.ok_or_else(|| operation.invalid("origin and target are the same point"))?;
    let left = up.try_normalize().and_then(|up| Some(up.cross(ahead)).filter(|left| left.length() > 1e-9));
    let left = left.ok_or_else(|| operation.invalid("up must not be 0 or along the direction of view"))?.normalize();
    Ok(DAffine3::from_mat3_translation(
        planted!("lookat_left": DMat3::from_cols(left, ahead.cross(left), ahead), DMat3::from_cols(-left, ahead.cross(left), ahead)),
        origin,
    ))
}

/// 16 or 9 numbers, row by row.
fn matrix(operation: Element<'_>) -> Result<DAffine3, Error> {
    operation.only_attributes(&["value"])?;
    let rows = operation.numbers(&operation.required("value")?)?;
    match rows.len() {
        9 => {
            let mut all = [0.0; 9];
            all.copy_from_slice(&rows);
            Ok(DAffine3::from_mat3(
                planted!("matrix_rows": DMat3::from_cols_array(&all).transpose(), DMat3::from_cols_array(&all)),
            ))
        }
        16 if rows[12..] == [0.0, 0.0, 0.0, 1.0] => {
            let column = |j: usize| DVec3::new(rows[j], rows[4 + j], rows[8 + j]);
            Ok(DAffine3::from_cols(column(0), column(1), column(2), column(3)))
        }
        16 => Err(operation.unsupported("the last row must be 0 0 0 1; projections are not supported")),
        other => Err(operation.invalid(format!("needs 9 or 16 numbers and has {other}"))),
    }
}

/// `transform`, if it can be inverted in `f32`.
pub(super) fn invertible(element: Element<'_>, transform: DAffine3) -> Result<DAffine3, Error> {
    let axes = [transform.x_axis, transform.y_axis, transform.z_axis].map(DVec3::length);
    let volume = transform.matrix3.determinant().abs() / (axes[0] * axes[1] * axes[2]);
    // NaN, of axes of length 0, fails too.
    if volume > 1e-6 && axes.iter().all(|length| (SHORTEST..=LONGEST).contains(length)) {
        return Ok(transform);
    }
    Err(element.invalid(format!(
        "to_world is singular: its axes have the lengths {:e}, {:e} and {:e}, and it leaves no volume or too much",
        axes[0], axes[1], axes[2]
    )))
}

/// The factor of a transform that scales uniformly, rotates and mirrors.
pub(super) fn uniform_scale(transform: &DAffine3) -> Option<f64> {
    let [x, y, z] = [transform.x_axis, transform.y_axis, transform.z_axis];
    let scale = x.length();
    let is_close = |a: f64, b: f64| (a - b).abs() <= 1e-5 * scale * scale;
    let is_uniform = is_close(y.length_squared(), scale * scale) && is_close(z.length_squared(), scale * scale);
    let is_right_angled = is_close(x.dot(y), 0.0) && is_close(y.dot(z), 0.0) && is_close(z.dot(x), 0.0);
    (is_uniform && is_right_angled).then_some(scale)
}

/// In `f32`.
pub(super) fn single(transform: &DAffine3) -> Affine3A {
    let [x, y, z, w]: [Vec3; 4] =
        [transform.x_axis, transform.y_axis, transform.z_axis, transform.translation].map(|column| column.as_vec3());
    Affine3A::from_cols(x.into(), y.into(), z.into(), w.into())
}
