//! The drawing of a figure.
//!
//! Input: a [`Figure`]. Output: its SVG, as text or in a file.

use super::raster::Raster;
use super::{DENSE, Field, Figure};
use crate::Error;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::prelude::*;
use std::path::Path;

type Drawn<T> = Result<T, Box<dyn core::error::Error>>;

/// The factor by which everything is drawn larger and displayed smaller: the backend rounds to
/// whole pixels, which would make steps in curves.
const FINE: u32 = 8;

/// A number on an axis, as short as it is exact to a few digits.
fn tick(x: &f64) -> String {
    let size = x.abs();
    if size < 1e-12 {
        "0".into()
    } else if (0.01..1e5).contains(&size) {
        // Rust writes the shortest decimal; rounding first removes the errors of adding steps of
        // the axis.
        format!("{}", (x * 1e6).round() / 1e6)
    } else {
        format!("{x:.1e}")
    }
}

/// A number on a logarithmic axis.
fn decade(x: f64) -> String {
    format!("{x:.0e}")
}

/// Colours that colour-blind people can distinguish too (Okabe and Ito).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(90, 90, 90),
];

/// The text whose element is replaced by the raster.
const PLACE: &str = "the place of the raster";

/// A number with three digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

impl Figure {
    /// Writes the figure as SVG; directories that are missing are created.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)?;
        }
        Ok(std::fs::write(path, self.svg()?)?)
    }

    /// The text of the figure as SVG.
    ///
    /// # Errors
    /// [`Error::Io`] with the message of what draws, for a range without numbers.
    pub fn svg(&self) -> Result<String, Error> {
        // With the margins below, a square of 640 for plots with one scale.
        let size = if self.equal { (756, 748) } else { (900, 580) };
        let (width, height) = (size.0 * FINE, size.1 * FINE);
        let mut text = String::new();
        let image = self.draw_all(&mut text, (width, height));
        let image = image.map_err(|error| std::io::Error::other(error.to_string()))?;
        if let Some(image) = image
            && let Some(place) = text.find(PLACE)
            && let Some(from) = text[..place].rfind("<text")
            && let Some(length) = text[from..].find("</text>")
        {
            let to = from + length + "</text>".len();
            text.replace_range(from..to, &image);
        }
        // It is displayed at the intended size.
        let drawn = format!("width=\"{width}\" height=\"{height}\"");
        let shown = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
        Ok(text.replacen(&drawn, &shown, 1))
    }

    /// The names of the curves, each once; those without a name are all different.
    fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for curve in &self.curves {
            if curve.name.is_empty() || !names.contains(&curve.name.as_str()) {
                names.push(&curve.name);
            }
        }
        names
    }

    fn draw_all(&self, text: &mut String, size: (u32, u32)) -> Drawn<Option<String>> {
        let drawing = SVGBackend::with_string(text, size).into_drawing_area();
        drawing.fill(&WHITE)?;
        let body = drawing
            .margin(14 * FINE, 0, 0, 0)
            .titled(&self.title, ("sans-serif", 20 * FINE))?;
        let corners: Vec<(f64, f64)> = (self.field.iter())
            .flat_map(|field| [(field.x.start, field.y.start), (field.x.end, field.y.end)])
            .collect();
        let all = || {
            self.curves
                .iter()
                .flat_map(|curve| &curve.points)
                .chain(&corners)
                .filter(|(x, y)| x.is_finite() && y.is_finite())
        };
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values.fold(f64::INFINITY..f64::NEG_INFINITY, |r, v| {
                r.start.min(v)..r.end.max(v)
            })
        };
        let mut x = range(&mut all().map(|(x, _)| *x));
        let mut builder = ChartBuilder::on(&body);
        builder
            .margin(16 * FINE)
            .x_label_area_size(44 * FINE)
            .y_label_area_size(84 * FINE);
        let image = if self.logarithmic {
            let shown = || all().map(|(_, y)| y.abs()).filter(|y| *y > 0.0);
            let smallest = shown().fold(f64::INFINITY, f64::min).max(1e-17);
            let largest = shown().fold(f64::NEG_INFINITY, f64::max);
            // Space for the legend above the curves, one line for each curve.
            let room = (0.05 * (1 + self.names().len()) as f64).max(0.2);
            let y = self
                .range
                .clone()
                .unwrap_or(smallest..largest * (largest / smallest).powf(room / (1.0 - room)));
            let visible = |y_value: f64| {
                (y_value.abs() >= y.start && y_value.abs() <= y.end).then_some(y_value.abs())
            };
            if self.decades {
                let (x, y) = (x.log_scale(), y.clone().log_scale());
                self.draw(&mut builder.build_cartesian_2d(x, y)?, visible)
            } else {
                let y = y.clone().log_scale();
                self.draw(&mut builder.build_cartesian_2d(x, y)?, visible)
            }
        } else {
            let y = self.range.clone().unwrap_or_else(|| {
                let y = range(&mut all().map(|(_, y)| *y));
                let span = (y.end - y.start).max(f64::MIN_POSITIVE);
                if self.equal {
                    // A square about the middle, with a margin, and the space of the legend on top.
                    let half = 0.53 * span.max(x.end - x.start);
                    let (middle, across) = (0.5 * (y.start + y.end), 0.5 * (x.start + x.end));
                    x = across - half..across + half;
                    middle - half..middle + half
                } else if self.field.is_some() {
                    y
                } else {
                    y.start - 0.05 * span..y.end + 0.3 * span
                }
            });
            let mut chart = builder.build_cartesian_2d(x, y.clone())?;
            self.draw(&mut chart, |y_value| {
                (y_value >= y.start && y_value <= y.end).then_some(y_value)
            })
        }?;
        drawing.present()?;
        drop(body);
        drop(drawing);
        Ok(image)
    }

    fn draw<'a, 'b: 'a, X, Y>(
        &self,
        chart: &mut ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, Y>>,
        visible: impl Fn(f64) -> Option<f64>,
    ) -> Drawn<Option<String>>
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        chart
            .configure_mesh()
            .x_desc(self.x.as_str())
            .y_desc(self.y.as_str())
            .x_label_formatter(&|x| if self.decades { decade(*x) } else { tick(x) })
            .y_label_formatter(&|y| {
                if self.logarithmic {
                    decade(*y)
                } else {
                    tick(y)
                }
            })
            .label_style(("sans-serif", 12 * FINE))
            .axis_desc_style(("sans-serif", 13 * FINE))
            .axis_style(BLACK.stroke_width(FINE))
            .set_all_tick_mark_size(5 * FINE)
            .light_line_style(WHITE.mix(0.0))
            .bold_line_style(BLACK.mix(0.12).stroke_width(FINE))
            .draw()?;
        let names = self.names();
        let mut legend = 0;
        let dots: usize = self.curves.iter().map(|curve| curve.points.len()).sum();
        let mut raster = (self.dots && dots > DENSE && self.field.is_none())
            .then(|| Raster::new(chart.plotting_area().get_pixel_range(), FINE as i32));
        // Few dots are as large as circles would be; many show more structure if they are small.
        let size_of_dots = if dots > 20_000 { 1 } else { 2 };
        if (raster.is_some() || self.field.is_some())
            && let Some((x, y)) = self.a_point(&visible)
        {
            let font = ("sans-serif", FINE);
            chart.draw_series([Text::new(PLACE, (x, y), font)])?;
        }
        let mut image = None;
        if let Some(field) = &self.field {
            let [(left, top), (right, bottom)] =
                [(field.x.start, field.y.end), (field.x.end, field.y.start)]
                    .map(|corner| chart.backend_coord(&corner));
            image = Some(field.element([left, top], [right - left, bottom - top]));
            let ends = field.ends();
            // A field without finite values has no colours to explain.
            let places: &[f64] = if ends.start > ends.end {
                &[]
            } else {
                &[1.0, 0.5, 0.0]
            };
            for &at in places {
                let value = ends.start + at * (ends.end - ends.start);
                let [red, green, blue] = Field::colour(at);
                let style = RGBColor(red, green, blue).filled();
                chart
                    .draw_series(std::iter::empty::<Circle<(f64, f64), u32>>())?
                    .label(tick(&rounded(value)))
                    .legend(move |(x, y)| {
                        let half = 6 * FINE as i32;
                        Rectangle::new([(x, y - half), (x + 24 * FINE as i32, y + half)], style)
                    });
            }
        }
        for (number, curve) in self.curves.iter().enumerate() {
            let named = names
                .iter()
                .position(|name| *name == curve.name && !name.is_empty());
            let colour = COLOURS[named.unwrap_or(number) % COLOURS.len()];
            let is_first = named.is_none_or(|named| named == legend);
            legend += usize::from(is_first);
            if self.dots {
                let points = curve.points.iter().filter(|(x, _)| x.is_finite());
                let shown = points.filter_map(|(x, y)| visible(*y).map(|y| (*x, y)));
                let mut single = Vec::new();
                match &mut raster {
                    Some(raster) => shown.for_each(|point| {
                        let RGBColor(red, green, blue) = colour;
                        let place = chart.backend_coord(&point);
                        raster.dot(place, size_of_dots, [red, green, blue]);
                    }),
                    None => single = shown.collect(),
                }
                let dots = single.into_iter();
                chart
                    .draw_series(dots.map(|point| Circle::new(point, FINE, colour.filled())))?
                    .label(&curve.name)
                    .legend(move |(x, y)| {
                        Circle::new((x + 12 * FINE as i32, y), 4 * FINE, colour.filled())
                    });
                continue;
            }
            // A curve that leaves the range is interrupted.
            let pieces = curve.points.split(|(_, y)| visible(*y).is_none());
            for (number, piece) in pieces.filter(|piece| piece.len() > 1).enumerate() {
                let line = LineSeries::new(
                    piece
                        .iter()
                        .filter_map(|(x, y)| visible(*y).map(|y| (*x, y))),
                    colour.stroke_width(2 * FINE),
                );
                let drawn = chart.draw_series(line)?;
                if number == 0 && is_first {
                    drawn.label(&curve.name).legend(move |(x, y)| {
                        PathElement::new(
                            [(x, y), (x + 24 * FINE as i32, y)],
                            colour.stroke_width(3 * FINE),
                        )
                    });
                }
            }
        }
        let font = ("sans-serif", 14 * FINE).into_font();
        chart.draw_series(self.marks.iter().filter_map(|((x, y), word)| {
            visible(*y).map(|y| {
                EmptyElement::at((*x, y))
                    + Text::new(
                        word.clone(),
                        (4 * FINE as i32, -6 * FINE as i32),
                        font.clone(),
                    )
            })
        }))?;
        let image = image.or_else(|| raster.as_ref().map(Raster::element));
        if self.field.is_none() && self.curves.iter().all(|curve| curve.name.is_empty()) {
            return Ok(image);
        }
        chart
            .configure_series_labels()
            .position(if self.legend_right {
                SeriesLabelPosition::UpperRight
            } else {
                SeriesLabelPosition::UpperLeft
            })
            .margin(10 * FINE)
            .legend_area_size(34 * FINE)
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.3).stroke_width(FINE))
            .label_font(("sans-serif", 14 * FINE))
            .draw()?;
        Ok(image)
    }

    /// A point that is drawn.
    fn a_point(&self, visible: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
        let corner = self
            .field
            .iter()
            .map(|field| (field.x.start, field.y.start));
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        let mut points = points.copied().chain(corner);
        points.find_map(|(x, y)| x.is_finite().then_some((x, visible(y)?)))
    }
}
