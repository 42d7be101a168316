// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/svg_canvas.h"

#include <cmath>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "lab/formats/png.h"

namespace plumescout::lab {
namespace {

std::string ColorCode(Rgb color) {
  return absl::StrFormat("#%02x%02x%02x", color.red, color.green, color.blue);
}

const char* AnchorName(Anchor anchor) {
  switch (anchor) {
    case Anchor::kStart:
      return "start";
    case Anchor::kMiddle:
      return "middle";
    case Anchor::kEnd:
      break;
  }
  return "end";
}

}  // namespace

std::string EscapeMarkup(absl::string_view text) {
  return absl::StrReplaceAll(
      text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}});
}

SvgCanvas::SvgCanvas(int width_px, int height_px, absl::string_view title)
    : body_(absl::StrFormat(
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" role=\"img\" "
          "font-family=\"sans-serif\">\n<title>%s</title>\n",
          width_px, height_px, EscapeMarkup(title))) {}

std::string SvgCanvas::Element() const { return absl::StrCat(body_, "</svg>\n"); }

void SvgCanvas::FillBox(const Box& box, Rgb color) {
  absl::StrAppendFormat(
      &body_, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\"/>\n", box.x,
      box.y, box.width, box.height, ColorCode(color));
}

void SvgCanvas::Polyline(std::span<const PixelPoint> points, const Stroke& stroke) {
  std::string path;
  bool pen_down = false;
  for (const PixelPoint& point : points) {
    const bool finite = std::isfinite(point.x) && std::isfinite(point.y);
    if (finite) absl::StrAppendFormat(&path, "%c%.2f %.2f", pen_down ? 'L' : 'M', point.x, point.y);
    pen_down = finite;
  }
  if (path.empty()) return;
  absl::StrAppendFormat(&body_,
                        "<path d=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%.2f\" "
                        "stroke-linecap=\"round\" stroke-linejoin=\"round\"",
                        path, ColorCode(stroke.color), stroke.width_px);
  if (stroke.dash_px > 0.0)
    absl::StrAppendFormat(&body_, " stroke-dasharray=\"%.2f\"", stroke.dash_px);
  body_ += "/>\n";
}

void SvgCanvas::Disc(PixelPoint center, double radius_px, Rgb color) {
  if (!std::isfinite(center.x) || !std::isfinite(center.y)) return;
  absl::StrAppendFormat(&body_, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\" fill=\"%s\"/>\n",
                        center.x, center.y, radius_px, ColorCode(color));
}

void SvgCanvas::Text(PixelPoint baseline, absl::string_view utf8, const TextStyle& style) {
  absl::StrAppendFormat(&body_,
                        "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%.2f\" fill=\"%s\" "
                        "text-anchor=\"%s\"%s>%s</text>\n",
                        baseline.x, baseline.y, style.size_px, ColorCode(style.color),
                        AnchorName(style.anchor), style.bold ? " font-weight=\"bold\"" : "",
                        EscapeMarkup(utf8));
}

void SvgCanvas::Picture(const Box& box, const Image& image) {
  const absl::StatusOr<std::string> png = EncodePng(image);
  if (!png.ok()) return;  // a picture without pixels shows nothing
  absl::StrAppendFormat(&body_,
                        "<image x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" "
                        "preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" "
                        "href=\"data:image/png;base64,%s\"/>\n",
                        box.x, box.y, box.width, box.height, absl::Base64Escape(*png));
}

}  // namespace plumescout::lab
