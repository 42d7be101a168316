// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/stroke_font.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"

namespace plumescout::lab {
namespace {

constexpr double kUnitsPerSize = 0.06;  // size of one font unit over the size of the font
constexpr double kSpacing_units = 3.2;  // between characters
constexpr double kBlank_units = 3.0;    // width of a blank, before spacing
constexpr int kSmoothingRounds = 2;     // of corner cutting: corners of 90 degrees look round
constexpr char kBaseline = 'e';

// A character is lines, parted by blanks; a line is points, each a column '0'..'9' and a row
// 'a'..'q', where 'e' is the base line, 'm' the height of small letters and 'q' that of capitals.
// '~' before a line rounds its corners.
constexpr char kBoxGlyph[] = "0e0o6o6e0e";
constexpr char kFirstGlyph = '!';
constexpr const char* kGlyphs[] = {
    "0q0i 0e0f",                                    // !
    "0q0n 2q2n",                                    // "
    "1e3q 5e7q 0i8i 0m8m",                          // #
    "~7o6p1p0n0l1k6k7j7h6f1f0g 3d3r",               // $
    "0e7q ~1q0q0n2n2q1q ~6h5h5e7e7h6h",             // %
    "~8e2m2p3q5q6p6n0i0g1e4e8j",                    // &
    "0q0n",                                         // '
    "~3r1o0k0g1c3a",                                // (
    "~0r2o3k3g2c0a",                                // )
    "3h3o 0j6m 0m6j",                               // *
    "0j6j 3g3m",                                    // +
    "1f0c",                                         // ,
    "0j4j",                                         // -
    "0e0f",                                         // .
    "0c5r",                                         // /
    "~3q1q0o0g1e6e7g7o6q3q",                        // 0
    "1n4q4e 1e7e",                                  // 1
    "~0o1q6q7o7l5j0e 0e7e",                         // 2
    "~0p1q6q7o7l6k3k ~3k6k7j7g6e1e0f",              // 3
    "5e5q0h7h",                                     // 4
    "6q1q0k ~0k1l6l7j7g6e1e0f",                     // 5
    "~6q3q0m0g1e6e7g7i6k1k0i",                      // 6
    "0q7q2e",                                       // 7
    "~4k1k0m0o1q6q7o7m6k4k ~4k1k0i0g1e6e7g7i6k4k",  // 8
    "~1e4e7i7o6q1q0o0m1k6k7m",                      // 9
    "0e0f 0k0l",                                    // :
    "1f0c 1k1l",                                    // ;
    "6o0j6e",                                       // <
    "0h6h 0l6l",                                    // =
    "0o6j0e",                                       // >
    "~0o1q5q6o6m3k3i 3e3f",                         // ?
    "~6h6l3l2j2h3g5g6i ~6h8h8n6q2q0n0g2d7d",        // @
    "0e4q8e 1h7h",                                  // A
    "0e0q ~0q6q7p7l6k0k ~0k6k8j8f6e0e",             // B
    "~8n7q1q0n0h1e7e8h",                            // C
    "0e0q ~0q5q8o8g5e0e",                           // D
    "7q0q0e7e 0k6k",                                // E
    "7q0q0e 0k6k",                                  // F
    "~8n7q1q0n0h1e7e8g8k 8k5k",                     // G
    "0e0q 8e8q 0k8k",                               // H
    "0e0q",                                         // I
    "~5q5g4e1e0g",                                  // J
    "0e0q 7q0j 2l7e",                               // K
    "0q0e6e",                                       // L
    "0e0q4i8q8e",                                   // M
    "0e0q8e8q",                                     // N
    "~4q1q0o0g1e7e8g8o7q4q",                        // O
    "0e0q ~0q6q8p8k6j0j",                           // P
    "~4q1q0o0g1e7e8g8o7q4q 5h8d",                   // Q
    "0e0q ~0q6q8p8k6j0j 4j8e",                      // R
    "~8o7q1q0o0l1k7k8j8g7e1e0g",                    // S
    "0q8q 4q4e",                                    // T
    "~0q0g1e7e8g8q",                                // U
    "0q4e8q",                                       // V
    "0q2e4n6e8q",                                   // W
    "0q8e 0e8q",                                    // X
    "0q4k8q 4k4e",                                  // Y
    "0q8q0e8e",                                     // Z
    "3r0r0b3b",                                     // [
    "0r5c",                                         // backslash
    "0r3r3b0b",                                     // ]
    "0m3q6m",                                       // ^
    "0c7c",                                         // _
    "0q2n",                                         // `
    "6m6e ~6k5m1m0k0g1e5e6g",                       // a
    "0q0e ~0k1m5m6k6g5e1e0g",                       // b
    "~6k5m1m0k0g1e5e6g",                            // c
    "6q6e ~6k5m1m0k0g1e5e6g",                       // d
    "0i6i ~6i6k5m1m0k0g1e5e6f",                     // e
    "~4q2q1o1e 0m4m",                               // f
    "~6m6c5a1a0b ~6k5m1m0k0g1e5e6g",                // g
    "0q0e ~0k1m5m6k6e",                             // h
    "0m0e 0p0q",                                    // i
    "~2m2b1a0a 2p2q",                               // j
    "0q0e 5m0h 2j5e",                               // k
    "~0q0f1e2e",                                    // l
    "0m0e ~0k1m3m4k4e ~4k5m7m8k8e",                 // m
    "0m0e ~0k1m5m6k6e",                             // n
    "~3m1m0k0g1e5e6g6k5m3m",                        // o
    "0m0a ~0k1m5m6k6g5e1e0g",                       // p
    "6m6a ~6k5m1m0k0g1e5e6g",                       // q
    "0m0e ~0k1m3m4m",                               // r
    "~5l4m1m0l0j1i4i5h5f4e1e0f",                    // s
    "~1p1g2e4e 0m4m",                               // t
    "~0m0g1e5e6g 6m6e",                             // u
    "0m3e6m",                                       // v
    "0m2e4l6e8m",                                   // w
    "0m6e 0e6m",                                    // x
    "0m3e ~6m3e2b1a0a",                             // y
    "0m6m0e6e",                                     // z
    "~3r1r1k0j ~0j1i1b3b",                          // {
    "0r0b",                                         // |
    "~0r2r2k3j ~3j2i2b0b",                          // }
    "~0i1k2k4i5i6k",                                // ~
};

// Beyond ASCII.
struct Sign {
  const char* utf8;
  const char* glyph;
};
constexpr Sign kSigns[] = {
    {"\u00B1", "0k6k 3h3n 0f6f"},      // plus or minus
    {"\u00B2", "~0p1q3q3o2m0k 0k3k"},  // superscript two
    {"\u2013", "0j7j"},                // en dash
};

// Takes the next character off the text and returns its glyph; nullptr is a blank.
const char* NextGlyph(absl::string_view& utf8) {
  for (const Sign& sign : kSigns) {
    if (absl::ConsumePrefix(&utf8, sign.utf8)) return sign.glyph;
  }
  const char c = utf8.front();
  utf8.remove_prefix(1);
  if (c == ' ') return nullptr;
  if (c >= kFirstGlyph && c < kFirstGlyph + static_cast<int>(std::size(kGlyphs))) {
    return kGlyphs[c - kFirstGlyph];
  }
  constexpr auto is_continuation = [](char byte) {
    return (static_cast<std::uint8_t>(byte) & 0xC0U) == 0x80U;
  };
  while (!utf8.empty() && is_continuation(utf8.front())) utf8.remove_prefix(1);
  return kBoxGlyph;
}

// Cuts every corner at a quarter of its sides (Chaikin 1974); the ends stay.
std::vector<PixelPoint> CutCorners(const std::vector<PixelPoint>& line) {
  const auto mix = [](PixelPoint a, PixelPoint b, double t) {
    return PixelPoint{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  };
  std::vector<PixelPoint> result = {line.front()};
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    result.push_back(mix(line[i], line[i + 1], 0.25));
    result.push_back(mix(line[i], line[i + 1], 0.75));
  }
  result.push_back(line.back());
  return result;
}

// The line that `code` stands for, in font units.
std::vector<PixelPoint> ParseLine(absl::string_view code) {
  const bool smooth = absl::ConsumePrefix(&code, "~");
  std::vector<PixelPoint> line;
  for (std::size_t i = 0; i + 1 < code.size(); i += 2) {
    line.push_back(
        {static_cast<double>(code[i] - '0'), static_cast<double>(kBaseline - code[i + 1])});
  }
  for (int round = 0; smooth && round < kSmoothingRounds; ++round) line = CutCorners(line);
  return line;
}

struct TextLines {
  std::vector<std::vector<PixelPoint>> lines;  // font units
  double width_units = 0.0;
};

TextLines LayOut(absl::string_view utf8) {
  TextLines text;
  double pen = 0.0;
  while (!utf8.empty()) {
    const char* const glyph = NextGlyph(utf8);
    double width = glyph == nullptr ? kBlank_units : 0.0;
    for (const absl::string_view code : absl::StrSplit(glyph == nullptr ? "" : glyph, ' ')) {
      std::vector<PixelPoint> line = ParseLine(code);
      for (PixelPoint& point : line) {
        width = std::max(width, point.x);
        point.x += pen;
      }
      if (!line.empty()) text.lines.push_back(std::move(line));
    }
    text.width_units = pen + width;
    pen += width + kSpacing_units;
  }
  return text;
}

}  // namespace

std::vector<std::vector<PixelPoint>> WriteText(absl::string_view utf8, double size_px) {
  std::vector<std::vector<PixelPoint>> lines = LayOut(utf8).lines;
  for (std::vector<PixelPoint>& line : lines) {
    for (PixelPoint& point : line) {
      point.x *= kUnitsPerSize * size_px;
      point.y *= kUnitsPerSize * size_px;
    }
  }
  return lines;
}

double TextWidth_px(absl::string_view utf8, double size_px) {
  return LayOut(utf8).width_units * kUnitsPerSize * size_px;
}

std::vector<std::string> WrapText(absl::string_view utf8, double size_px, double width_px) {
  std::vector<std::string> lines;
  for (const absl::string_view word : absl::StrSplit(utf8, ' ', absl::SkipEmpty())) {
    const std::string longer =
        lines.empty() ? std::string(word) : absl::StrCat(lines.back(), " ", word);
    if (!lines.empty() && TextWidth_px(longer, size_px) <= width_px) {
      lines.back() = longer;
    } else {
      lines.emplace_back(word);
    }
  }
  return lines;
}

}  // namespace plumescout::lab
