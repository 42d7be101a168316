// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "lab/report/canvas.h"
#include "lab/report/font.h"

namespace plumescout::lab {

struct WrittenText {
  PixelPoint baseline;
  std::string utf8;
  TextStyle style;

  // End of a text that starts at `baseline`.
  double right() const { return baseline.x + TextWidth_px(utf8, style.size_px, style.bold); }
};

struct DrawnLine {
  std::vector<PixelPoint> points;
  Stroke stroke;
};

struct DrawnDisc {
  PixelPoint center;
  double radius_px = 0.0;
  Rgb color;
};

// Keeps what is drawn, in order, except pictures.
class RecordingCanvas final : public Canvas {
 public:
  std::vector<WrittenText> texts;
  std::vector<DrawnLine> lines;
  std::vector<DrawnDisc> discs;
  std::vector<PixelBox> boxes;

  // All that is written, each text between ">" and "<".
  std::string Texts() const {
    std::string all;
    for (const WrittenText& text : texts) all += ">" + text.utf8 + "<";
    return all;
  }

  void FillBox(const PixelBox& box, Rgb) override { boxes.push_back(box); }
  void Polyline(std::span<const PixelPoint> points, const Stroke& stroke) override {
    lines.push_back({{points.begin(), points.end()}, stroke});
  }
  void Disc(PixelPoint center, double radius_px, Rgb color) override {
    discs.push_back({center, radius_px, color});
  }
  void Text(PixelPoint baseline, absl::string_view utf8, const TextStyle& style) override {
    texts.push_back({baseline, std::string(utf8), style});
  }
  void Picture(const PixelBox&, const Image&) override {}
};

}  // namespace plumescout::lab
