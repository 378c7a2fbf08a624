//! Small PNG files of few colours.
//!
//! Input: a palette and the number of a colour for each pixel. Output: the bytes of an indexed PNG, with
//! colour 0 transparent. Sources: W3C, "Portable Network Graphics (PNG) Specification", third edition
//! (2025); P. Deutsch, RFC 1950 (zlib) and RFC 1951 (deflate, with the fixed codes of section 3.2.6).

/// Encodes an image of `width` columns. Colour n of a pixel is `palette[n - 1]`, 0 is transparent; there
/// are at most 255 colours.
pub(super) fn encode(width: usize, pixels: &[u8], palette: &[[u8; 3]]) -> Vec<u8> {
    let depth = match palette.len() {
        0..=1 => 1,
        2..=3 => 2,
        4..=15 => 4,
        _ => 8_usize,
    };
    let mut lines = Vec::with_capacity(pixels.len() * depth / 8 + pixels.len() / width.max(1));
    for row in pixels.chunks(width.max(1)) {
        lines.push(0); // no filter
        for packed in row.chunks(8 / depth) {
            let byte = (packed.iter().enumerate())
                .map(|(place, colour)| colour << (8 - depth * (place + 1)))
                .fold(0, |byte, bits| byte | bits);
            lines.push(byte);
        }
    }
    let height = pixels.len().checked_div(width).unwrap_or(0);
    let mut header = Vec::new();
    header.extend((width as u32).to_be_bytes());
    header.extend((height as u32).to_be_bytes());
    // Indexed colours, deflate, the filters, no interlace.
    header.extend([depth as u8, 3, 0, 0, 0]);
    let mut colours = vec![255; 3];
    colours.extend(palette.iter().flatten());

    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut file, b"IHDR", &header);
    chunk(&mut file, b"PLTE", &colours);
    chunk(&mut file, b"tRNS", &[0]);
    chunk(&mut file, b"IDAT", &zlib(&lines));
    chunk(&mut file, b"IEND", &[]);
    file
}

/// Length, type, content and checksum.
fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], content: &[u8]) {
    file.extend((content.len() as u32).to_be_bytes());
    let from = file.len();
    file.extend(kind);
    file.extend(content);
    let checksum = crc32(&file[from..]);
    file.extend(checksum.to_be_bytes());
}

/// The cyclic redundancy check of PNG, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
        })
    })
}

fn adler32(bytes: &[u8]) -> u32 {
    let (low, high) = bytes.iter().fold((1_u32, 0_u32), |(low, high), byte| {
        let low = (low + u32::from(*byte)) % 65_521;
        (low, (high + low) % 65_521)
    });
    high << 16 | low
}

/// One block with the fixed codes; matches are found by the last position of the same three bytes.
fn zlib(bytes: &[u8]) -> Vec<u8> {
    /// The farthest match of deflate, and the longest.
    const WINDOW: usize = 32_768;
    const LONGEST: usize = 258;
    let mut bits = Bits {
        bytes: vec![0x78, 0x01],
        pending: 0,
        count: 0,
    };
    bits.push(1, 1); // the last block
    bits.push(1, 2); // fixed codes
    let mut places = vec![usize::MAX; 1 << 15];
    let mut at = 0;
    let key = |at: usize| {
        let three = bytes.get(at..at + 3)?;
        let word = u32::from_le_bytes([three[0], three[1], three[2], 0]);
        Some((word.wrapping_mul(0x9e37_79b1) >> 17) as usize)
    };
    while at < bytes.len() {
        let before = key(at).map(|key| std::mem::replace(&mut places[key], at));
        let length =
            (before.filter(|before| *before < at && at - before <= WINDOW)).map_or(0, |before| {
                let same = bytes[at..].iter().zip(&bytes[before..]);
                same.take(LONGEST).take_while(|(a, b)| a == b).count()
            });
        match before {
            Some(before) if length >= 3 => {
                bits.length(length);
                bits.distance(at - before);
                for inside in at + 1..at + length {
                    if let Some(key) = key(inside) {
                        places[key] = inside;
                    }
                }
                at += length;
            }
            _ => {
                bits.symbol(u32::from(bytes[at]));
                at += 1;
            }
        }
    }
    bits.symbol(256);
    let mut zlib = bits.finished();
    zlib.extend(adler32(bytes).to_be_bytes());
    zlib
}

/// Bits, from the lowest of each byte.
struct Bits {
    bytes: Vec<u8>,
    pending: u64,
    count: u32,
}

impl Bits {
    fn push(&mut self, value: u32, count: u32) {
        self.pending |= u64::from(value) << self.count;
        self.count += count;
        while self.count >= 8 {
            self.bytes.push(self.pending as u8);
            self.pending >>= 8;
            self.count -= 8;
        }
    }

    /// Codes of Huffman stand with their highest bit first.
    fn code(&mut self, code: u32, count: u32) {
        self.push(code.reverse_bits() >> (32 - count), count);
    }

    /// A byte, the end of the block, or a class of lengths.
    fn symbol(&mut self, symbol: u32) {
        match symbol {
            0..=143 => self.code(0x30 + symbol, 8),
            144..=255 => self.code(0x190 + symbol - 144, 9),
            256..=279 => self.code(symbol - 256, 7),
            _ => self.code(0xc0 + symbol - 280, 8),
        }
    }

    /// The length of a match, 3 to 258: four classes for each number of further bits.
    fn length(&mut self, length: usize) {
        let rest = length as u32 - 3;
        match rest {
            255 => self.symbol(285),
            0..=7 => self.symbol(257 + rest),
            _ => {
                let further = rest.ilog2() - 2;
                self.symbol(257 + 4 * further + (rest >> further));
                self.push(rest & ((1 << further) - 1), further);
            }
        }
    }

    /// The distance of a match, 1 to 32768: two classes for each number of further bits.
    fn distance(&mut self, distance: usize) {
        let rest = distance as u32 - 1;
        match rest {
            0..=3 => self.code(rest, 5),
            _ => {
                let further = rest.ilog2() - 1;
                self.code(2 * further + (rest >> further), 5);
                self.push(rest & ((1 << further) - 1), further);
            }
        }
    }

    fn finished(mut self) -> Vec<u8> {
        if self.count > 0 {
            self.bytes.push(self.pending as u8);
        }
        self.bytes
    }
}

/// RFC 4648, section 4.
pub(super) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |at: usize| u32::from(three.get(at).copied().unwrap_or(0));
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * place) & 63) as usize];
            text.push(if place > three.len() {
                '='
            } else {
                char::from(letter)
            });
        }
    }
    text
}
