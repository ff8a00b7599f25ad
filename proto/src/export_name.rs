//! How the file of an exported take is called.

use crate::v1::{Take, TakeFormat};

/// Longest slate or id in a name.
const MAX_STEM_CHARS: usize = 64;

/// Slate and take number, as `12A_3.csv`, or the take's id where it has no slate. A slate's letters and digits of any script
/// stay; what a file system or a shell might misread becomes a dash.
pub fn export_file_name(take: &Take, format: TakeFormat) -> String {
    let (suffix, extension) = match format {
        TakeFormat::Unspecified | TakeFormat::Mcap => ("", "mcap"),
        TakeFormat::Csv => ("", "csv"),
        // The app's own files are named SLATE_TAKE_DEVICE.
        TakeFormat::LiveLinkCsv => ("_Frontalis", "csv"),
        TakeFormat::Glb => ("", "glb"),
        TakeFormat::Trc => ("", "trc"),
        TakeFormat::C3d => ("", "c3d"),
    };
    let plain = |text: &str| -> String {
        let letters = text.chars().take(MAX_STEM_CHARS).map(plain);
        letters.collect::<String>().trim_matches('-').to_owned()
    };
    let slate = plain(&take.slate);
    let stem = if slate.is_empty() {
        plain(take.name.rsplit('/').next().unwrap_or_default())
    } else {
        format!("{slate}_{}", take.number)
    };
    format!("{stem}{suffix}.{extension}")
}

fn plain(letter: char) -> char {
    if letter.is_alphanumeric() || letter == '_' {
        letter
    } else {
        '-'
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_named_by_slate_and_number_and_leads_nowhere() {
        for (slate, expected) in [
            ("12A", "12A_3.trc"),
            ("", "stage-1-19f3.trc"),
            ("..", "stage-1-19f3.trc"),
            ("../etc/passwd", "etc-passwd_3.trc"),
            ("Übung 1", "Übung-1_3.trc"),
            ("a\nb\"", "a-b_3.trc"),
        ] {
            let take = Take {
                name: "takes/stage-1-19f3".to_owned(),
                slate: slate.to_owned(),
                number: 3,
                ..Take::default()
            };
            assert_eq!(export_file_name(&take, TakeFormat::Trc), expected);
        }
    }
}
