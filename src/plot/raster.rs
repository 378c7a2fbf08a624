//! Clouds of dots, and other pixels, as an image.
//!
//! Input: dots, or pixels with a palette. Output: an image in an SVG. Invariant: dots outside of the area are left out.

use super::png::{base64, encode};
use std::ops::Range;

/// The pixels of a plotting area, one number of a colour each; 0 is none.
pub(super) struct Raster {
    /// The area in the units of the drawing.
    area: (Range<i32>, Range<i32>),
    /// Units of the drawing in a pixel.
    fine: i32,
    width: usize,
    height: usize,
    pixels: Vec<u8>,
    palette: Vec<[u8; 3]>,
}

impl Raster {
    pub(super) fn new(area: (Range<i32>, Range<i32>), fine: i32) -> Self {
        let pixels = |range: &Range<i32>| ((range.end - range.start) / fine).max(1) as usize;
        let (width, height) = (pixels(&area.0), pixels(&area.1));
        Raster {
            area,
            fine,
            width,
            height,
            pixels: vec![0; width * height],
            palette: Vec::new(),
        }
    }

    /// Draws a dot of `size`² pixels; pixels outside the area are omitted.
    pub(super) fn dot(&mut self, (x, y): (i32, i32), size: usize, colour: [u8; 3]) {
        let known = self.palette.iter().position(|known| *known == colour);
        let number = known.unwrap_or_else(|| {
            self.palette.push(colour);
            self.palette.len() - 1
        });
        let (x, y) = (x - self.area.0.start, y - self.area.1.start);
        let (column, row) = (x.div_euclid(self.fine), y.div_euclid(self.fine));
        let (column, row) = (usize::try_from(column), usize::try_from(row));
        if let (Ok(column), Ok(row)) = (column, row) {
            for row in row..(row + size).min(self.height) {
                for column in column..(column + size).min(self.width) {
                    self.pixels[row * self.width + column] = number as u8 + 1;
                }
            }
        }
    }

    /// The element of an SVG.
    pub(super) fn element(&self) -> String {
        let size = [self.width, self.height].map(|pixels| pixels as i32 * self.fine);
        let corner = [self.area.0.start, self.area.1.start];
        element(corner, size, self.width, &self.pixels, &self.palette)
    }
}

/// The element of an SVG with an image, at a place and of a size in the units of the drawing.
pub(super) fn element(
    [x, y]: [i32; 2],
    [across, down]: [i32; 2],
    width: usize,
    pixels: &[u8],
    palette: &[[u8; 3]],
) -> String {
    format!(
        "<image x=\"{x}\" y=\"{y}\" width=\"{across}\" height=\"{down}\" preserveAspectRatio=\"none\" \
         image-rendering=\"pixelated\" href=\"data:image/png;base64,{}\"/>",
        base64(&encode(width, pixels, palette))
    )
}
