// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "absl/strings/string_view.h"
#include "lab/report/image.h"

namespace plumescout::lab {

// Position on a canvas: pixels from its top left corner, y downwards.
struct PixelPoint {
  double x = 0.0;
  double y = 0.0;
};

// Part of a canvas.
struct PixelBox {
  double x = 0.0;  // left
  double y = 0.0;  // top
  double width = 0.0;
  double height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

struct Stroke {
  Rgb color;
  double width_px = 1.0;
  double dash_px = 0.0;  // length of dashes and of the gaps between them; 0: solid

  friend bool operator==(const Stroke&, const Stroke&) = default;
};

enum class Anchor { kStart, kMiddle, kEnd };

struct TextStyle {
  double size_px = 12.0;  // of the font; capitals are 0.73 of it
  Rgb color;
  Anchor anchor = Anchor::kStart;
  bool bold = false;
};

// Where figures are drawn. A figure is written once and drawn into a page as well as into a picture
// (cairo_canvas.h). What lies beyond the canvas is cut off.
class Canvas {
 public:
  virtual ~Canvas() = default;

  virtual void FillBox(const PixelBox& box, Rgb color) = 0;
  // Round joints and ends. Points that are not finite part the line.
  virtual void Polyline(std::span<const PixelPoint> points, const Stroke& stroke) = 0;
  virtual void Disc(PixelPoint center, double radius_px, Rgb color) = 0;
  // `baseline` is the start, middle or end of the base line, as the style's anchor says.
  virtual void Text(PixelPoint baseline, absl::string_view utf8, const TextStyle& style) = 0;
  // The image fills the box; its pixels become crisp rectangles.
  virtual void Picture(const PixelBox& box, const Image& image) = 0;
};

}  // namespace plumescout::lab
