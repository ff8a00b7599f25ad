//! What of an OBJ is read, and which line is named when it is refused.

use proptest::prelude::*;

use super::*;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

fn square() -> Obj {
    Obj {
        vertices: vec![
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

fn refused(text: impl AsRef<[u8]>) -> (usize, ObjProblem, &'static str) {
    let error = parse(text.as_ref()).unwrap_err();
    (error.line, error.problem, error.reason())
}

#[test]
fn polygons_are_fanned_and_other_lines_skipped() {
    assert_eq!(parse(SQUARE.as_bytes()), Ok(square()));
    let dressed =
        "# made by hand\nmtllib a.mtl\no face\nvn 0 0 1\nvt 0 0\ng skin\ns off\nusemtl x\n"
            .to_owned()
            + "v 0 0 0 1.0\nv 1 0 0 # corner\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nf 1/1/1 2//1 3/1 4\nl 1 2\n";
    assert_eq!(parse(dressed.as_bytes()), Ok(square()));
}

#[test]
fn d6_line_ends_tabs_byte_order_mark_and_a_missing_last_line_end_are_fine() {
    let variants = [
        SQUARE.replace('\n', "\r\n"),
        SQUARE.replace(' ', "\t "),
        SQUARE.trim_end().to_owned(),
        format!("\u{feff}{SQUARE}"),
        format!("\n \n{SQUARE}\n\n"),
    ];
    for variant in variants {
        assert_eq!(parse(variant.as_bytes()), Ok(square()), "{variant:?}");
    }
}

#[test]
fn d6_what_is_not_an_obj_is_refused_with_its_line() {
    assert_eq!(refused(""), (1, ObjProblem::NoVertices, "PARSE"));
    assert_eq!(refused("# a\n# b\n"), (3, ObjProblem::NoVertices, "PARSE"));
    assert_eq!(refused("f 1 2 3\n").2, "PARSE");
    assert_eq!(
        refused("v 0 0 0\nv 1,5 2 3\n"),
        (2, ObjProblem::NotANumber, "PARSE")
    );
    assert_eq!(
        refused("v 0 0\n"),
        (1, ObjProblem::Coordinates { found: 2 }, "PARSE")
    );
    assert_eq!(
        refused("v 0 0 0 1 1 1 1 1 1\n"),
        (1, ObjProblem::Coordinates { found: 8 }, "PARSE")
    );
    assert_eq!(
        refused("v 0 0 0\nv 0 0 0 x\n"),
        (2, ObjProblem::NotANumber, "PARSE")
    );
    assert_eq!(refused("v 0 0 0\n\0\n"), (2, ObjProblem::Nul, "PARSE"));
    assert_eq!(
        refused(b"v 0 0 0\n\n# \xff\n"),
        (3, ObjProblem::NotUtf8, "PARSE")
    );
}

#[test]
fn d6_a_line_of_64_kib_is_read_and_a_longer_one_is_refused() {
    let comment = |length: usize| format!("v 0 0 0\n#{}", "x".repeat(length - 1));
    assert!(parse(comment(MAX_LINE_BYTES).as_bytes()).is_ok());
    assert_eq!(
        refused(comment(MAX_LINE_BYTES + 1)),
        (2, ObjProblem::LineTooLong, "PARSE")
    );
}

#[test]
fn d3_non_finite_vertices_are_refused_with_their_line() {
    for word in [
        "nan",
        "NaN",
        "-nan",
        "inf",
        "-Infinity",
        "1e39",
        "-1e39",
        "1e400",
    ] {
        let text = format!("v 0 0 0\n\nv 0 {word} 0\n");
        let (line, problem, reason) = refused(text);
        if word == "-nan" {
            assert!(matches!(
                problem,
                ObjProblem::NonFinite | ObjProblem::NotANumber
            ));
        } else {
            assert_eq!(
                (line, problem, reason),
                (3, ObjProblem::NonFinite, "NON_FINITE"),
                "{word}"
            );
        }
    }
    assert!(parse(b"v 3.4e38 -0.0 1e-320\n").is_ok());
}

#[test]
fn d4_face_indices_that_name_no_vertex_are_refused_with_their_line() {
    let with = |face: &str| format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n{face}\n");
    let reasons = [
        ("f 0 1 2", ObjProblem::IndexZero),
        (
            "f 1 2 4",
            ObjProblem::IndexBeyond {
                index: 4,
                n_vertices: 3,
            },
        ),
        (
            "f 1 2 -4",
            ObjProblem::IndexBeyond {
                index: -4,
                n_vertices: 3,
            },
        ),
        (
            "f 1 2 4294967297",
            ObjProblem::IndexBeyond {
                index: 4_294_967_297,
                n_vertices: 3,
            },
        ),
        (
            "f 1 2 -9223372036854775808",
            ObjProblem::IndexBeyond {
                index: i64::MIN,
                n_vertices: 3,
            },
        ),
        ("f 1 2 99999999999999999999", ObjProblem::CornerSyntax),
        ("f 1 2 1.5", ObjProblem::CornerSyntax),
        ("f 1 2 /3", ObjProblem::CornerSyntax),
        ("f 1 2 2", ObjProblem::RepeatedVertex { index: 2 }),
        ("f 1 2 -2", ObjProblem::RepeatedVertex { index: 2 }),
        ("f 1 2", ObjProblem::TooFewCorners { found: 2 }),
        ("f", ObjProblem::TooFewCorners { found: 0 }),
    ];
    for (face, problem) in reasons {
        assert_eq!(refused(with(face)), (5, problem, "FACE_INDEX"), "{face}");
    }
}

#[test]
fn d4_a_polygon_with_very_many_corners_is_refused() {
    let vertices = "v 0 0 0\n".repeat(2_000);
    let corners: Vec<_> = (1..=1_000).map(|corner| corner.to_string()).collect();
    let corners = corners.join(" ");
    let (line, problem, reason) = refused(format!("{vertices}f {corners}\n"));
    assert_eq!(
        (line, problem, reason),
        (2_001, ObjProblem::TooManyCorners, "FACE_INDEX")
    );
}

#[test]
fn faces_may_count_back_and_may_come_before_their_vertices() {
    let counted_back = SQUARE.replace("f 1 2 3 4", "f -4 -3 -2 -1");
    assert_eq!(parse(counted_back.as_bytes()), Ok(square()));
    let ahead = "f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    assert_eq!(parse(ahead.as_bytes()), Ok(square()));
}

#[test]
fn d7_more_vertices_or_triangles_than_the_limit_are_refused_at_the_line() {
    let vertices = "v 0 0 0\n".repeat(MAX_VERTICES + 1);
    assert_eq!(
        refused(vertices),
        (MAX_VERTICES + 1, ObjProblem::TooManyVertices, "BASIS_SIZE")
    );
    let faces = "f 1 2 3\n".repeat(MAX_TRIANGLES + 1);
    assert_eq!(
        refused(faces),
        (
            MAX_TRIANGLES + 1,
            ObjProblem::TooManyTriangles,
            "BASIS_SIZE"
        )
    );
}

proptest! {
    #[test]
    fn what_is_written_reads_back_to_the_same_bits(
        vertices in prop::collection::vec([-1e6..1e6, -1e-6..1e-6, -1e30..1e30], 3..20),
    ) {
        let obj = Obj { vertices, triangles: vec![[0, 1, 2]] };
        let text = write(obj.vertices.iter().copied(), &obj.triangles);
        prop_assert_eq!(parse(text.as_bytes()), Ok(obj));
    }

    #[test]
    fn no_bytes_make_the_reader_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(parse(&bytes).is_ok() || parse(&bytes).is_err());
    }

    #[test]
    fn no_lines_make_the_reader_panic(text in "([vf#] ?([-0-9/.e]{0,20}|nan|inf)( [-0-9/.e]{0,4}){0,4}\n){0,20}") {
        prop_assert!(parse(text.as_bytes()).is_ok() || parse(text.as_bytes()).is_err());
    }
}
