//! The golden values: exact biases and mean squared errors, found by enumeration in rational
//! arithmetic by an independent program (schemas `rcv-golden-1` and `rcv-golden-beyond-1`).

use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;

/// A file of golden values.
#[derive(Debug, Deserialize)]
pub struct Golden {
    /// The discrete laws.
    pub distributions: Vec<Law>,
    /// Laws with h = 0 at a point.
    #[serde(default)]
    pub singular: Vec<Law>,
    /// Laws of paths of two steps.
    #[serde(default)]
    pub nested: Vec<Nested>,
    /// Vectors to be summed by importance sampling.
    #[serde(default)]
    pub importance_sampling: Vec<ImportanceSampling>,
}

/// A vector-valued function on a few points, ways to sample them, and the total variance of each.
#[derive(Debug, Deserialize)]
pub struct ImportanceSampling {
    /// Its name.
    pub name: String,
    /// `f[channel][point]`.
    pub f: Vec<Vec<f64>>,
    /// A density over the points.
    #[serde(deserialize_with = "fractions")]
    pub g: Vec<f64>,
    /// Densities of channels or strata, `gk[k][point]`.
    #[serde(deserialize_with = "tables")]
    pub gk: Vec<Vec<f64>>,
    /// Probabilities of channels.
    #[serde(deserialize_with = "fractions")]
    pub pk: Vec<f64>,
    /// Probabilities of acceptance, `accept[channel][point]`.
    #[serde(deserialize_with = "tables")]
    pub accept: Vec<Vec<f64>>,
    /// The channels of each stratum.
    pub strata: Vec<Vec<usize>>,
    /// The number of draws.
    #[serde(rename = "N")]
    pub n: u64,
    /// Of each stratum.
    #[serde(rename = "Nk")]
    pub nk: Vec<u64>,
    /// F, per channel.
    #[serde(rename = "F")]
    pub total: Vec<Number>,
    /// Total variances by id.
    pub variance: BTreeMap<String, Number>,
    /// The density of the least total variance.
    pub optimal_g: Vec<Number>,
}

/// A law of paths of two steps, and what estimators make of it.
#[derive(Debug, Deserialize)]
pub struct Nested {
    /// Its name.
    pub name: String,
    /// The first step.
    pub stage1: Vec<First>,
    /// The second step, given the point of the first.
    pub stage2: Vec<Vec<Second>>,
    /// F = E\[y₁y₂\].
    #[serde(rename = "F", deserialize_with = "number")]
    pub f: f64,
    /// H₁.
    #[serde(rename = "H1")]
    pub h1: Number,
    /// H₂ given the point of the first step.
    #[serde(rename = "H2")]
    pub h2: Vec<Number>,
    /// What the ratio inside the integral converges to.
    pub naive_limit: Number,
    /// Exact moments of the estimators.
    pub results: Vec<Record>,
}

/// A point of the first step.
#[derive(Debug, Deserialize)]
pub struct First {
    /// The probability.
    #[serde(deserialize_with = "fraction")]
    pub p: f64,
    /// f₁/g₁.
    #[serde(deserialize_with = "fraction")]
    pub y1: f64,
    /// h₁/g₁.
    #[serde(deserialize_with = "fraction")]
    pub x1: f64,
}

/// A point of the second step.
#[derive(Debug, Deserialize)]
pub struct Second {
    /// The probability, given the first point.
    #[serde(deserialize_with = "fraction")]
    pub q: f64,
    /// f₂/g₂.
    #[serde(deserialize_with = "fraction")]
    pub y2: f64,
    /// h₂/g₂.
    #[serde(deserialize_with = "fraction")]
    pub x2: f64,
}

/// A discrete law of draws, and what each estimator makes of it.
#[derive(Debug, Deserialize)]
pub struct Law {
    /// Its name.
    pub name: String,
    /// Its points.
    pub support: Vec<Point>,
    /// F = E\[y\].
    #[serde(rename = "F", deserialize_with = "number")]
    pub f: f64,
    /// H, of one auxiliary or of three.
    #[serde(rename = "H")]
    pub h: OneOrMany,
    /// Population moments.
    #[serde(default)]
    pub constants: Option<Constants>,
    /// Exact moments of the estimators.
    pub results: Vec<Record>,
    /// Estimates from single samples.
    #[serde(default)]
    pub pointwise: Vec<Pointwise>,
}

/// A point of a law.
#[derive(Debug, Deserialize)]
pub struct Point {
    /// f/g.
    #[serde(deserialize_with = "fraction")]
    pub y: f64,
    /// The auxiliaries over g.
    #[serde(deserialize_with = "fractions")]
    pub x: Vec<f64>,
    /// The probability.
    #[serde(deserialize_with = "fraction")]
    pub p: f64,
    /// The weights of two techniques.
    #[serde(default, deserialize_with = "fractions")]
    pub w: Vec<f64>,
}

/// The exact moments of an estimator.
#[derive(Debug, Deserialize)]
pub struct Record {
    /// The estimator's id.
    pub id: String,
    /// Its parameters.
    pub params: Params,
    /// The number of draws.
    #[serde(rename = "N")]
    pub n: usize,
    /// E\[F̂\]; absent if the estimate is not always defined.
    #[serde(default, deserialize_with = "maybe_number")]
    pub expectation: Option<f64>,
    /// E\[F̂\] − F.
    #[serde(default, deserialize_with = "maybe_number")]
    pub bias: Option<f64>,
    /// E\[(F̂ − F)²\].
    #[serde(default, deserialize_with = "maybe_number")]
    pub mse: Option<f64>,
    /// The probability that the estimate is not defined.
    #[serde(default, deserialize_with = "maybe_number")]
    pub p_singular: Option<f64>,
}

/// Parameters that the estimators of this suite have.
#[derive(Debug, Default, Deserialize)]
pub struct Params {
    /// The divisor of covariances is N − ddof.
    pub ddof: Option<u32>,
    /// The defensive weight.
    #[serde(default, deserialize_with = "maybe_number")]
    pub eps: Option<f64>,
    /// The number of groups.
    pub groups: Option<usize>,
    /// The coefficients, one per auxiliary, or a single one.
    alpha: Option<OneOrMany>,
    /// The coefficients of a difference.
    beta: Option<Vec<Number>>,
    /// The range of α.
    pub clamp: Option<Vec<Number>>,
    /// α where it is not determined.
    #[serde(default, deserialize_with = "maybe_number")]
    pub fallback_alpha: Option<f64>,
    /// What becomes of dependent auxiliaries: `min_norm` or `zero`.
    pub singular: Option<String>,
    /// The number of auxiliaries.
    #[serde(rename = "K")]
    pub auxiliaries: Option<usize>,
    /// The weights of techniques.
    pub weights: Option<Weights>,
}

/// The weights of a deterministic mixture.
#[derive(Clone, Copy, Debug, Deserialize)]
pub enum Weights {
    /// Those of the points.
    #[serde(rename = "w")]
    Given,
    /// w_k = x_k/Σx_j.
    #[serde(rename = "balance")]
    Balance,
}

impl Params {
    /// α or β, one per auxiliary.
    pub fn coefficients(&self) -> Vec<f64> {
        match (&self.alpha, &self.beta) {
            (Some(alpha), _) => alpha.all(),
            (None, Some(beta)) => beta.iter().map(|number| number.0).collect(),
            (None, None) => Vec::new(),
        }
    }
}

/// Estimates from one sample.
#[derive(Debug, Deserialize)]
pub struct Pointwise {
    /// Points of the support in the order of the draws.
    pub sample: Vec<usize>,
    /// The estimates.
    pub values: Vec<Value>,
}

/// One estimate.
#[derive(Debug, Deserialize)]
pub struct Value {
    /// The estimator's id.
    pub id: String,
    /// Its parameters.
    pub params: Params,
    /// The estimate.
    #[serde(deserialize_with = "number")]
    pub value: f64,
}

/// Population moments, as far as they are compared.
#[derive(Debug, Deserialize)]
pub struct Constants {
    /// `C[ij]`.
    #[serde(rename = "C")]
    pub c: BTreeMap<String, Number>,
    /// Coefficients of 1/N.
    pub first_order: BTreeMap<String, Number>,
    /// Coefficients of 1/N² of the bias.
    pub second_order_bias: BTreeMap<String, Number>,
}

/// H of one auxiliary, or of all.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub enum OneOrMany {
    /// Of the first.
    One(Number),
    /// Of each.
    Many(Vec<Number>),
}

impl OneOrMany {
    /// H of the first auxiliary.
    pub fn first(&self) -> f64 {
        match self {
            Self::One(number) => number.0,
            Self::Many(numbers) => numbers[0].0,
        }
    }

    /// Of every auxiliary.
    pub fn all(&self) -> Vec<f64> {
        match self {
            Self::One(number) => vec![number.0],
            Self::Many(numbers) => numbers.iter().map(|number| number.0).collect(),
        }
    }
}

/// `{"d": "decimal", "q": "p/q"}`, rounded to the nearest double.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        number(deserializer).map(Number)
    }
}

#[derive(Deserialize)]
struct Decimal {
    d: String,
}

fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let Decimal { d } = Decimal::deserialize(deserializer)?;
    d.parse().map_err(serde::de::Error::custom)
}

fn maybe_number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    number(deserializer).map(Some)
}

fn parse_fraction(text: &str) -> Result<f64, core::num::ParseFloatError> {
    match text.split_once('/') {
        None => text.parse(),
        Some((p, q)) => Ok(p.parse::<f64>()? / q.parse::<f64>()?),
    }
}

fn fraction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    parse_fraction(&String::deserialize(deserializer)?).map_err(serde::de::Error::custom)
}

fn fractions<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
    let texts = Vec::<String>::deserialize(deserializer)?;
    texts.iter().map(|text| parse_fraction(text).map_err(serde::de::Error::custom)).collect()
}

fn tables<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Vec<f64>>, D::Error> {
    #[derive(Deserialize)]
    struct Row(#[serde(deserialize_with = "fractions")] Vec<f64>);
    Ok(Vec::<Row>::deserialize(deserializer)?.into_iter().map(|Row(row)| row).collect())
}

/// The estimators of the seed on six laws, and singular laws.
pub fn seed() -> Golden {
    serde_json::from_str(include_str!("../golden/golden_public.json")).expect("golden_public.json")
}

/// Grouped Mickey and others beyond the supplement, on the same laws.
pub fn beyond() -> Golden {
    serde_json::from_str(include_str!("../golden/golden_beyond_public.json")).expect("golden_beyond_public.json")
}
