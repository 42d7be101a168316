// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "absl/strings/string_view.h"
#include "lab/formats/image.h"
#include "lab/report/canvas.h"

namespace plumescout::lab {

// Draws into an SVG element that stands for itself, to be put into a page; pictures are embedded.
class SvgCanvas final : public Canvas {
 public:
  // `title` is for readers that cannot see the figure.
  SvgCanvas(int width_px, int height_px, absl::string_view title);

  // The element with everything drawn so far.
  std::string Element() const;

  void FillBox(const Box& box, Rgb color) override;
  void Polyline(std::span<const PixelPoint> points, const Stroke& stroke) override;
  void Disc(PixelPoint center, double radius_px, Rgb color) override;
  void Text(PixelPoint baseline, absl::string_view utf8, const TextStyle& style) override;
  void Picture(const Box& box, const Image& image) override;

 private:
  std::string body_;
};

// The text with the characters that mean something in HTML and XML replaced.
std::string EscapeMarkup(absl::string_view text);

}  // namespace plumescout::lab
