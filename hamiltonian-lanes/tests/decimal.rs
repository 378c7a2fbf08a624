//! Double-doubles from and to decimal text (`reference/decimal.txt`).

use hamiltonian_lanes::{DoubleDouble, ParseDoubleDoubleError, Real};

fn read(text: &str) -> Result<DoubleDouble, ParseDoubleDoubleError> {
    text.parse()
}

#[test]
fn text_is_rounded_to_the_nearest_words() {
    for line in include_str!("reference/decimal.txt").lines() {
        let [text, hi, lo, _] = line.split(' ').collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        let words = [hi, lo].map(|w| f64::from_bits(u64::from_str_radix(w, 16).unwrap()));
        let number = read(text).unwrap();
        assert_eq!([number.hi(), number.lo()], words, "{text}");
    }
}

#[test]
fn thirty_two_digits_are_correctly_rounded() {
    for line in include_str!("reference/decimal.txt").lines() {
        let [_, hi, lo, digits] = line.split(' ').collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        let [hi, lo] = [hi, lo].map(|w| f64::from_bits(u64::from_str_radix(w, 16).unwrap()));
        let number = DoubleDouble::new(hi, lo);
        assert_eq!(format!("{number:e}"), digits);
        // The displayed number is the same to 32 digits.
        let again = read(&number.to_string()).unwrap();
        assert!(
            ((again - number) / number).magnitude() < 5.1e-32,
            "{number}"
        );
        assert_eq!(again.to_string(), number.to_string());
    }
}

#[test]
fn every_form_is_read() {
    let number = |x: f64| Ok(DoubleDouble::from(x));
    for (text, value) in [
        ("1", 1.0),
        ("+1.5", 1.5),
        ("-.5", -0.5),
        ("2.", 2.0),
        ("125e-2", 1.25),
        ("0.0000e99999999999999999999", 0.0),
        ("1E3", 1000.0),
        ("1e+3", 1000.0),
        ("1e400", f64::INFINITY),
        ("-1e99999999999999999999", f64::NEG_INFINITY),
        ("1e-500", 0.0),
        ("Infinity", f64::INFINITY),
        ("-inf", f64::NEG_INFINITY),
        ("4.9406564584124654e-324", 5e-324),
    ] {
        assert_eq!(read(text), number(value), "{text}");
    }
    assert!(read("NaN").unwrap().hi().is_nan());
    assert!(read("-0").unwrap().hi().is_sign_negative());
    // 2¹¹⁰ + 2⁵³ + 1 is midway between two trailing words; digits beyond 80 still decide.
    let tie = "1298074214633706916139823337046017";
    assert_eq!(read(tie).unwrap().lo(), 9007199254740992.0);
    let above = format!("{tie}.{}1", "0".repeat(90));
    assert_eq!(read(&above).unwrap().lo(), 9007199254740994.0);
    let long = format!("1{}", "0".repeat(300));
    assert_eq!(read(&long), read("1e300"));
}

#[test]
fn what_is_no_number_is_refused() {
    for text in [
        "", "-", ".", "e5", "1e", "1e+", "1.2.3", "1,5", "0x10", " 1", "1_000", "--1", "∞",
    ] {
        assert_eq!(read(text), Err(ParseDoubleDoubleError), "{text}");
    }
    assert_eq!(ParseDoubleDoubleError.to_string(), "not a decimal number");
}

#[test]
fn numbers_are_written_as_they_are_read() {
    for text in [
        "0",
        "-0",
        "inf",
        "-inf",
        "NaN",
        "1",
        "-1.5",
        "100",
        "0.1",
        "0.00001234",
        "1.234e-6",
        "99999999999999999999999999999999",
        "1e32",
        "1.7e308",
        "-2.5e-200",
    ] {
        assert_eq!(read(text).unwrap().to_string(), text);
    }
}

#[test]
fn format_options_are_those_of_floats() {
    let number = read("-1234.5678").unwrap();
    assert_eq!(format!("{number:>12}"), "  -1234.5678");
    assert_eq!(format!("{:+}", -number), "+1234.5678");
    assert_eq!(format!("{number:.2e}"), "-1.23e3");
    assert_eq!(format!("{:.0e}", read("9.6").unwrap()), "1e1");
    assert_eq!(format!("{:.2e}", read("0.125").unwrap()), "1.25e-1");
    // Ties to even; more digits than 38 are not computed.
    assert_eq!(format!("{:.1e}", read("0.125").unwrap()), "1.2e-1");
    assert_eq!(
        format!("{:.99e}", read("0.5").unwrap()),
        format!("5.{}e-1", "0".repeat(37))
    );
    assert_eq!(
        format!("{:e}", DoubleDouble::from(5e-324)),
        "4.9406564584124654417656879286822e-324"
    );
    assert_eq!(
        format!("{:e}", DoubleDouble::from(f64::MAX)),
        "1.7976931348623157081452742373170e308"
    );
}
