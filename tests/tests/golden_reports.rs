//! Are the reports of the main variants what they were? `LUCERNA_BLESS=1` writes them anew; the difference is then for a human.

use std::path::Path;

use hostsim::accelerate::{Setup, Units};
use hostsim::render::{Options, default_normal_test, render};
use indicatif::ProgressBar;
use lucerna_driver::{Hazard, NumberFormat, Policies};
use serde_json::{Map, Value};

/// Fields that say how fast the host was.
const HOST: [&str; 3] = ["host_seconds", "host_operations_per_second", "host_speed_over_reference"];

/// Floating-point figures are compared in nine digits: the pictures behind them go through the host's `powf`.
fn tidy(value: Value) -> Value {
    match value {
        Value::Number(number) if number.is_f64() => {
            let text = format!("{:.8e}", number.as_f64().expect("just asked"));
            Value::from(text.parse::<f64>().expect("just printed"))
        }
        Value::Object(fields) => {
            Value::Object(fields.into_iter().map(|(name, value)| (name, tidy(value))).collect())
        }
        other => other,
    }
}

fn report(out: &Path, format: NumberFormat, hazard: Hazard, units: Units) -> Value {
    let setup = Setup {
        units,
        format,
        policies: Policies { hazard, ..Policies::default() },
        normal_test: default_normal_test(hazard),
        ..Setup::default()
    };
    let options = Options {
        scene: "cornell-balls".to_owned(),
        mesh: None,
        width: 20,
        height: 15,
        photons: 1_000,
        setup,
        out: out.to_owned(),
    };
    render(&options, &ProgressBar::hidden()).unwrap_or_else(|error| panic!("{error}"));
    let text = std::fs::read_to_string(out.join("report.json")).unwrap();
    let mut fields: Map<String, Value> = serde_json::from_str(&text).unwrap();
    for field in HOST {
        assert!(fields.remove(field).is_some(), "no {field} in the report");
    }
    tidy(Value::Object(fields))
}

#[test]
fn reports_are_as_committed() {
    let out = tempfile::tempdir().unwrap();
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/reports.json");
    let mut reports = Map::new();
    for format in [NumberFormat::F32, NumberFormat::F24] {
        for hazard in [Hazard::Interlock, Hazard::Forward, Hazard::Published] {
            for units in [Units::Four, Units::Eight, Units::Sixteen] {
                let name = format!("{} {} {}", format.name(), hazard.name(), units.count());
                let report = report(out.path(), format, hazard, units);
                // Protected, the bits are the scalar loop's; and how many PREUs there are changes no hit point.
                assert_eq!(report["bits_equal_scalar"], Value::from(hazard != Hazard::Published), "{name}");
                reports.insert(name, report);
            }
        }
    }
    let text = serde_json::to_string_pretty(&reports).unwrap() + "\n";
    if std::env::var_os("LUCERNA_BLESS").is_some() {
        std::fs::write(&golden, &text).unwrap();
    }
    let committed: Map<String, Value> =
        serde_json::from_str(&std::fs::read_to_string(&golden).unwrap()).unwrap();
    assert_eq!(committed.keys().collect::<Vec<_>>(), reports.keys().collect::<Vec<_>>());
    for (name, report) in &reports {
        let (now, then) = (report.as_object().unwrap(), committed[name].as_object().unwrap());
        assert_eq!(now.keys().collect::<Vec<_>>(), then.keys().collect::<Vec<_>>(), "{name}");
        for (field, value) in now {
            assert_eq!(value, &then[field], "{name}: {field}; if it is meant, run with LUCERNA_BLESS=1");
        }
    }
}
