//! Tables of curves, and names that stay one harmless field.

use proptest::prelude::*;

use super::*;
use crate::timecode::TimecodeRate;

fn table(rows: &[CurveRow<'_>], muscles: &[&str], columns: CurveColumns) -> String {
    let muscles = muscles.iter().copied();
    let mut writer = CurveCsvWriter::new(Vec::new(), muscles, columns).unwrap();
    for row in rows {
        writer.write_row(row).unwrap();
    }
    String::from_utf8(writer.finish().unwrap()).unwrap()
}

fn row() -> CurveRow<'static> {
    CurveRow {
        frame: 7,
        capture_time_nanos: 116_666_667,
        quality: Some(Quality::Partial),
        timecode: Some(Timecode::parse("01:02:03;04", TimecodeRate::NTSC_DROP).unwrap()),
        activations: &[0.0, 0.25, -1e-9],
        standard_errors: &[0.5, 0.0, 0.125],
    }
}

#[test]
fn a_line_holds_frame_time_quality_and_every_muscle() {
    let muscles = ["frontalis_left", "jaw", "kiss"];
    let held = CurveRow {
        frame: 8,
        quality: Some(Quality::Held),
        timecode: None,
        ..row()
    };
    assert_eq!(
        table(&[row(), held], &muscles, CurveColumns::default()),
        "frame,capture_time_nanos,quality,frontalis_left,jaw,kiss\n\
         7,116666667,partial,0,0.25,-0.000000001\n\
         8,116666667,held,0,0.25,-0.000000001\n"
    );
    let all = CurveColumns {
        timecode: true,
        standard_errors: true,
    };
    assert_eq!(
        table(&[row(), held], &muscles, all),
        "frame,capture_time_nanos,quality,timecode,frontalis_left,jaw,kiss,\
         frontalis_left_standard_error,jaw_standard_error,kiss_standard_error\n\
         7,116666667,partial,01:02:03;04,0,0.25,-0.000000001,0.5,0,0.125\n\
         8,116666667,held,,0,0.25,-0.000000001,0.5,0,0.125\n"
    );
}

#[test]
fn names_stay_one_inert_field() {
    for (name, expected) in [
        ("jaw", "jaw"),
        ("a,b", "\"a,b\""),
        ("say \"a\"", "\"say \"\"a\"\"\""),
        ("=1+1", "'=1+1"),
        ("+1", "'+1"),
        ("-1+1", "'-1+1"),
        ("@SUM(A1)", "'@SUM(A1)"),
        ("\t=1", "'\t=1"),
        ("\r=1", "\"'\r=1\""),
        ("=1,1", "\"'=1,1\""),
        ("a\nb", "\"a\nb\""),
    ] {
        assert_eq!(field(name), expected, "{name:?}");
    }
}

/// What RFC 4180 reads back from one record.
fn fields(record: &str) -> Vec<String> {
    let (mut fields, mut quoted) = (vec![String::new()], false);
    let mut chars = record.chars().peekable();
    while let Some(c) = chars.next() {
        let last = fields.last_mut().unwrap();
        match c {
            '"' if quoted && chars.peek() == Some(&'"') => last.extend(chars.next()),
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => last.push(c),
        }
    }
    fields
}

proptest! {
    #[test]
    fn every_name_is_read_back_and_never_a_formula(names in prop::collection::vec("[ -~\t\r\n]{0,12}", 1..5)) {
        let heading = table(&[], &names.iter().map(String::as_str).collect::<Vec<_>>(), CurveColumns::default());
        let read = fields(heading.strip_suffix('\n').unwrap());
        prop_assert_eq!(read.len(), 3 + names.len());
        for (read, name) in read[3..].iter().zip(&names) {
            prop_assert!(!read.starts_with(['=', '+', '-', '@', '\t', '\r']));
            prop_assert_eq!(read.strip_prefix('\'').filter(|it| it == name).unwrap_or(read), name);
        }
    }

    #[test]
    fn every_value_reads_back_to_the_same_bits(value in any::<f32>().prop_filter("finite", |it| it.is_finite())) {
        let row = CurveRow { activations: &[value], ..row() };
        let text = table(&[row], &["x"], CurveColumns::default());
        let last = text.trim_end().rsplit(',').next().unwrap();
        prop_assert_eq!(last.parse::<f32>().unwrap().to_bits(), value.to_bits());
    }
}
