//! Parameters of the precise method, read from its source files.

use std::fs;
use std::path::Path;

/// Folder of the files with parameters, relative to the workspace.
pub const FOLDER: &str = "farseer-precise/src/parameters";
/// Names of files whose parameters are measured first: those of the newest methods.
const FIRST: [&str; 2] = ["joints", "direct"];

/// A parameter of the precise method: a line `pub(...) const NAME: TYPE = VALUE;` below a doc comment with `Unit: ...`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Name of the file that defines the parameter, without `.rs`.
    pub module: String,
    /// Name of the constant.
    pub name: String,
    /// Unit of the parameter: the words between `Unit:` and the next full stop of its doc comment.
    pub unit: String,
    /// Value of the parameter as the source text has it.
    pub value: String,
    /// Type of the parameter as the source text has it.
    kind: String,
}

/// Returns all parameters, those of joints and of the direct solver first.
///
/// # Errors
///
/// A file cannot be read, or a parameter has no unit.
pub fn parameters(workspace: &Path) -> Result<Vec<Parameter>, String> {
    let folder = workspace.join(FOLDER);
    let unread = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut all = Vec::new();
    for entry in fs::read_dir(&folder).map_err(unread)? {
        let path = entry.map_err(unread)?.path();
        let module = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        all.extend(parameters_of(module, &fs::read_to_string(&path).map_err(unread)?)?);
    }
    let place = |module: &str| FIRST.iter().position(|first| *first == module).unwrap_or(FIRST.len());
    all.sort_by_key(|number| (place(&number.module), number.module.clone()));
    Ok(all)
}

/// Returns the parameters of a source text, in the order of the text; `module` is the name of the file.
fn parameters_of(module: &str, text: &str) -> Result<Vec<Parameter>, String> {
    let (mut all, mut above) = (Vec::new(), String::new());
    for line in text.lines() {
        if let Some(doc) = line.strip_prefix("///") {
            above += doc;
        } else if let Some((name, kind, value)) = constant(line) {
            let unit = above.split_once("Unit: ").and_then(|(_, rest)| Some(rest.split_once('.')?.0));
            let unit = unit.ok_or_else(|| format!("{name} has no unit"))?.to_owned();
            let [name, kind, value] = [name, kind, value].map(str::to_owned);
            all.push(Parameter { module: module.to_owned(), name, unit, value, kind });
            above.clear();
        } else {
            above.clear();
        }
    }
    Ok(all)
}

/// Returns name, type and value of a line that defines a constant; `None` for other lines.
fn constant(line: &str) -> Option<(&str, &str, &str)> {
    let (_, rest) = line.split_once("const ")?;
    let (name, rest) = rest.split_once(": ")?;
    let (kind, value) = rest.split_once(" = ")?;
    Some((name, kind, value.strip_suffix(';')?))
}

impl Parameter {
    /// Returns the path of the file that defines the parameter, relative to the workspace.
    pub fn file(&self) -> String {
        format!("{FOLDER}/{}.rs", self.module)
    }

    /// Returns an expression for `factor` times the value; `None` if it equals the value. Integers are rounded to the
    /// nearest one of the type, at least 1. For a cosine the small angle is multiplied. Parameters whose unit ends with `at
    /// most 1` stay at most 1.
    pub fn times(&self, factor: f64) -> Option<String> {
        let Some(inner) = self.value.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) else {
            let value = self.one_times(&self.kind, &self.value, factor);
            return (value != self.value).then_some(value);
        };
        let kind = self.kind.trim_start_matches('[').split(';').next().unwrap_or_default();
        let values: Vec<_> = inner.split(", ").map(|value| self.one_times(kind, value, factor)).collect();
        Some(format!("[{}]", values.join(", ")))
    }

    fn one_times(&self, kind: &str, value: &str, factor: f64) -> String {
        if !kind.starts_with('f') {
            return whole_times(kind, value, factor);
        }
        if self.unit.ends_with("a cosine") {
            return format!("{kind}::max(1.0 - {:?} * (1.0 - {value}), -1.0)", factor * factor);
        }
        let product = format!("{factor:?} * ({value})");
        if self.unit.ends_with("at most 1") { format!("{kind}::min({product}, 1.0)") } else { product }
    }

    /// Returns the source text of the file with another value of this parameter.
    pub fn written_into(&self, text: &str, value: &str) -> String {
        let line = |line: &str| match constant(line) {
            Some((name, ..)) if name == self.name => {
                let (before, _) = line.split_once(" = ").unwrap_or((line, ""));
                format!("{before} = {value};\n")
            }
            _ => format!("{line}\n"),
        };
        text.lines().map(line).collect()
    }
}

fn whole_times(kind: &str, value: &str, factor: f64) -> String {
    let Ok(number) = value.replace('_', "").parse::<f64>() else { return value.to_owned() };
    let most = if kind == "u8" { f64::from(u8::MAX) } else { f64::from(i32::MAX) };
    let product = (factor * number.abs()).round().clamp(1.0, most).copysign(number);
    if product == number { value.to_owned() } else { format!("{product}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn workspace() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
    }

    fn number(kind: &str, unit: &str, value: &str) -> Parameter {
        let [module, name] = ["joints", "SPEED"].map(str::to_owned);
        Parameter { module, name, unit: unit.into(), value: value.into(), kind: kind.into() }
    }

    #[test]
    fn every_parameter_of_the_method_has_a_unit_and_can_be_changed_in_its_file() {
        let parameters = parameters(workspace()).unwrap();
        assert!(parameters.len() > 150, "{}", parameters.len());
        for number in &parameters {
            let text = fs::read_to_string(workspace().join(number.file())).unwrap();
            assert!(text.matches(" const ").count() >= 1);
            for factor in [0.5, 2.0] {
                let Some(value) = number.times(factor) else { continue };
                let changed = parameters_of(&number.module, &number.written_into(&text, &value)).unwrap();
                let before = parameters_of(&number.module, &text).unwrap();
                let others = changed.iter().zip(&before).filter(|(one, other)| one != other);
                assert_eq!(others.count(), 1, "{} times {factor}", number.name);
                assert!(changed.iter().any(|one| one.name == number.name && one.value == value));
            }
            assert!(number.times(2.0).is_some(), "{} has no double", number.name);
        }
    }

    #[test]
    fn every_constant_among_the_parameters_is_on_one_line_and_read() {
        for entry in fs::read_dir(workspace().join(FOLDER)).unwrap() {
            let path = entry.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let constants = text.lines().filter(|line| line.contains("const ") && !line.starts_with("//"));
            let read = parameters_of("", &text).unwrap();
            assert_eq!(constants.count(), read.len(), "{}", path.display());
        }
    }

    #[test]
    fn names_of_parameters_are_unique() {
        let mut names: Vec<_> =
            parameters(workspace()).unwrap().into_iter().map(|number| number.name).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn parameters_are_multiplied_by_their_kinds() {
        let value = |kind, unit, value| number(kind, unit, value).times(2.0);
        assert_eq!(value("f64", "Hz", "60.0").as_deref(), Some("2.0 * (60.0)"));
        assert_eq!(value("u8", "dimensionless, updates", "200").as_deref(), Some("255"));
        assert_eq!(value("usize", "dimensionless, a count", "2_000_000").as_deref(), Some("4000000"));
        assert_eq!(value("i32", "dimensionless", "-32").as_deref(), Some("-64"));
        assert_eq!(
            value("f32", "dimensionless, at most 1", "0.6").as_deref(),
            Some("f32::min(2.0 * (0.6), 1.0)")
        );
        assert_eq!(value("[f64; 2]", "s", "[4.0, 20.0]").as_deref(), Some("[2.0 * (4.0), 2.0 * (20.0)]"));
        assert_eq!(
            value("f32", "dimensionless, a cosine", "0.98").as_deref(),
            Some("f32::max(1.0 - 4.0 * (1.0 - 0.98), -1.0)")
        );
        assert_eq!(number("u32", "dimensionless, a count", "1").times(0.5), None);
    }
}
