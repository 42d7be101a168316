// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "absl/strings/string_view.h"
#include "lab/formats/image.h"
#include "lab/report/canvas.h"

namespace plumescout::lab {

// Draws into an image, with anti-aliased lines, discs and text.
class RasterCanvas final : public Canvas {
 public:
  RasterCanvas(int width_px, int height_px, Rgb background);

  const Image& image() const { return image_; }

  void FillBox(const Box& box, Rgb color) override;
  void Polyline(std::span<const PixelPoint> points, const Stroke& stroke) override;
  void Disc(PixelPoint center, double radius_px, Rgb color) override;
  void Text(PixelPoint baseline, absl::string_view utf8, const TextStyle& style) override;
  void Picture(const Box& box, const Image& image) override;

 private:
  // Pixels [x_begin, x_end) x [y_begin, y_end).
  struct PixelRange {
    int x_begin = 0;
    int y_begin = 0;
    int x_end = 0;
    int y_end = 0;
  };
  PixelRange Clip(double left, double top, double right, double bottom) const;

  // Covers the segment, widened by half the width, in coverage_.
  void CoverSegment(PixelPoint a, PixelPoint b, double half_width_px);
  // Blends `color` in where coverage_ says so, and clears coverage_.
  void BlendCovered(Rgb color);

  Image image_;
  // Share of each pixel under the shape being drawn, [0, 1]; zero between calls. A line is covered
  // whole before it is blended, so its joints are not darker than the rest.
  std::vector<float> coverage_;
  PixelRange covered_;  // holds every pixel with coverage > 0
};

}  // namespace plumescout::lab
