//! Line plots as SVG: curves with names, axes with labels, a legend, a logarithmic axis on request.

use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;
use std::error::Error;
use std::ops::Range;
use std::path::Path;

/// A named curve.
pub struct Curve {
    pub name: String,
    pub points: Vec<(f64, f64)>,
}

/// A figure.
pub struct Figure<'a> {
    pub title: &'a str,
    pub x: &'a str,
    pub y: &'a str,
    /// Whether y is |y| on a logarithmic axis.
    pub logarithmic: bool,
    /// The range of y; of all curves if `None`.
    pub range: Option<Range<f64>>,
    pub curves: Vec<Curve>,
}

/// Told apart by people who see colours differently too (Okabe and Ito).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(90, 90, 90),
];

impl Figure<'_> {
    /// Writes the figure.
    pub fn write(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let drawing = SVGBackend::new(path, (900, 560)).into_drawing_area();
        drawing.fill(&WHITE)?;
        let all = || {
            self.curves
                .iter()
                .flat_map(|curve| &curve.points)
                .filter(|(_, y)| y.is_finite())
        };
        let x = all().fold(f64::INFINITY..f64::NEG_INFINITY, |r, (x, _)| {
            r.start.min(*x)..r.end.max(*x)
        });
        let mut builder = ChartBuilder::on(&drawing);
        builder
            .caption(self.title, ("sans-serif", 20))
            .margin(16)
            .x_label_area_size(44)
            .y_label_area_size(84);
        if self.logarithmic {
            let shown = || all().map(|(_, y)| y.abs()).filter(|y| *y > 0.0);
            let smallest = shown().fold(f64::INFINITY, f64::min).max(1e-17);
            let largest = shown().fold(f64::NEG_INFINITY, f64::max);
            // Room for the legend above the curves.
            let y = self
                .range
                .clone()
                .unwrap_or(smallest..largest * (largest / smallest).powf(0.25));
            let mut chart = builder.build_cartesian_2d(x, y.clone().log_scale())?;
            self.draw(&mut chart, |y_value| {
                (y_value.abs() >= y.start && y_value.abs() <= y.end).then_some(y_value.abs())
            })
        } else {
            let y = self.range.clone().unwrap_or_else(|| {
                let y = all().fold(f64::INFINITY..f64::NEG_INFINITY, |r, (_, y)| {
                    r.start.min(*y)..r.end.max(*y)
                });
                let span = (y.end - y.start).max(f64::MIN_POSITIVE);
                y.start - 0.05 * span..y.end + 0.3 * span
            });
            let mut chart = builder.build_cartesian_2d(x, y.clone())?;
            self.draw(&mut chart, |y_value| {
                (y_value >= y.start && y_value <= y.end).then_some(y_value)
            })
        }?;
        drawing.present()?;
        Ok(())
    }

    fn draw<'a, 'b: 'a, Y>(
        &self,
        chart: &mut ChartContext<
            'a,
            SVGBackend<'b>,
            Cartesian2d<plotters::coord::types::RangedCoordf64, Y>,
        >,
        visible: impl Fn(f64) -> Option<f64>,
    ) -> Result<(), Box<dyn Error>>
    where
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        chart
            .configure_mesh()
            .x_desc(self.x)
            .y_desc(self.y)
            .y_label_formatter(&|y| {
                if *y == 0.0 {
                    "0".into()
                } else {
                    format!("{y:.1e}")
                }
            })
            .light_line_style(WHITE.mix(0.0))
            .bold_line_style(BLACK.mix(0.12))
            .draw()?;
        for (curve, colour) in self.curves.iter().zip(COLOURS.iter().cycle()) {
            let colour = *colour;
            // A curve that leaves the range is cut there, not joined across.
            let pieces = curve.points.split(|(_, y)| visible(*y).is_none());
            for (number, piece) in pieces.filter(|piece| piece.len() > 1).enumerate() {
                let line = LineSeries::new(
                    piece
                        .iter()
                        .filter_map(|(x, y)| visible(*y).map(|y| (*x, y))),
                    colour.stroke_width(2),
                );
                let drawn = chart.draw_series(line)?;
                if number == 0 {
                    drawn.label(&curve.name).legend(move |(x, y)| {
                        PathElement::new([(x, y), (x + 24, y)], colour.stroke_width(3))
                    });
                }
            }
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .legend_area_size(34)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3))
            .label_font(("sans-serif", 14))
            .draw()?;
        Ok(())
    }
}
