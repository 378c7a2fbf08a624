//! MathML of what the LaTeX printer writes.

use hamiltonian_symbolic::print::mathml;

/// Tags that are open at each place are closed in their order, and nothing else is between `<` and `>`.
fn assert_well_formed(markup: &str) {
    let mut open = Vec::new();
    let mut rest = markup;
    while let Some(at) = rest.find('<') {
        assert!(
            !rest[..at].contains(['>', '&']) || rest[..at].contains(';'),
            "{markup}"
        );
        let end = at + rest[at..].find('>').expect(markup);
        let tag = &rest[at + 1..end];
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name), "{markup}"),
            None => open.push(tag.split(' ').next().unwrap_or_default()),
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty(), "{open:?} in {markup}");
}

#[test]
fn formulas_are_set_as_in_print() {
    for (latex, expected) in [
        (
            r"\frac{p^{2}}{2 m l^{2}} - m g l \cos(\theta)",
            "<mfrac><msup><mi>p</mi><mn>2</mn></msup><mrow><mn>2</mn><mi>m</mi><msup><mi>l</mi><mn>2</mn></msup></mrow></mfrac>\
             <mo>−</mo><mi>m</mi><mi>g</mi><mi>l</mi><mspace width=\"0.17em\"></mspace>\
             <mi>cos</mi><mo>\u{2061}</mo><mrow><mo>(</mo><mi>θ</mi><mo>)</mo></mrow>",
        ),
        (
            r"p_{\theta}^{2} \sin^{2}(\theta)",
            "<msubsup><mi>p</mi><mi>θ</mi><mn>2</mn></msubsup><mspace width=\"0.17em\"></mspace><msup><mi>sin</mi><mn>2</mn></msup><mo>\u{2061}</mo>\
             <mrow><mo>(</mo><mi>θ</mi><mo>)</mo></mrow>",
        ),
        (
            r"\left|q\right| + \sqrt[3]{x}",
            "<mrow><mo>|</mo><mi>q</mi><mo>|</mo></mrow><mo>+</mo><mroot><mi>x</mi><mn>3</mn></mroot>",
        ),
        (
            r"\mathrm{mass} \phi_{\mathrm{dot}}",
            "<mi mathvariant=\"normal\">mass</mi><mspace width=\"0.17em\"></mspace><msub><mi>φ</mi><mi mathvariant=\"normal\">dot</mi></msub>",
        ),
        (
            r"2 \mathrm{va} + q \mathrm{d} t",
            "<mn>2</mn><mspace width=\"0.17em\"></mspace><mi mathvariant=\"normal\">va</mi><mo>+</mo><mi>q</mi>\
             <mi mathvariant=\"normal\">d</mi><mi>t</mi>",
        ),
        (
            r"\begin{cases} p & \text{if } q < 0 \\ 2 p & \text{otherwise} \end{cases}",
            "<mrow><mo>{</mo><mtable><mtr><mtd><mi>p</mi></mtd><mtd><mtext>if\u{a0}</mtext><mi>q</mi><mo>&lt;</mo><mn>0</mn>\
             </mtd></mtr><mtr><mtd><mn>2</mn><mi>p</mi></mtd><mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>",
        ),
        (
            r"\sum_{i=0}^{N - 1} m_{i}",
            "<munderover><mo>∑</mo><mrow><mi>i</mi><mo>=</mo><mn>0</mn></mrow><mrow><mi>N</mi><mo>−</mo><mn>1</mn></mrow>\
             </munderover><msub><mi>m</mi><mi>i</mi></msub>",
        ),
        (
            r"-V'(x) + 1.5 \cdot 10^{-30}",
            "<mo>−</mo><msup><mi>V</mi><mo>′</mo></msup><mrow><mo>(</mo><mi>x</mi><mo>)</mo></mrow><mo>+</mo><mn>1.5</mn><mo>⋅</mo>\
             <msup><mn>10</mn><mrow><mo>−</mo><mn>30</mn></mrow></msup>",
        ),
    ] {
        let found = mathml(latex).unwrap_or_else(|| panic!("{latex} is not known"));
        assert_eq!(found, expected, "{latex}");
        assert_well_formed(&found);
    }
}

#[test]
fn what_the_printer_does_not_write_has_no_translation() {
    for latex in [
        r"\unknown",
        r"\frac{a}{b",
        r"\frac{a}",
        r"\left(a",
        "a & b",
        "a }",
        "(a",
        "a)",
        r"\begin{matrix} a",
    ] {
        assert_eq!(mathml(latex), None, "{latex}");
    }
    let nested = |depth: usize| format!("{}q{}", r"\sqrt{".repeat(depth), "}".repeat(depth));
    assert!(mathml(&nested(60)).is_some());
    assert_eq!(mathml(&nested(100_000)), None);
}
