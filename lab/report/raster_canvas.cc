// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/raster_canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lab/report/stroke_font.h"

namespace plumescout::lab {
namespace {

// Widths of the pen over the size of the font.
constexpr double kPen = 0.085;
constexpr double kBoldPen = 0.135;

bool IsFinite(PixelPoint point) { return std::isfinite(point.x) && std::isfinite(point.y); }

double Distance_px(PixelPoint a, PixelPoint b) { return std::hypot(b.x - a.x, b.y - a.y); }

double DistanceToSegment_px(PixelPoint p, PixelPoint a, PixelPoint b) {
  const PixelPoint d{b.x - a.x, b.y - a.y};
  const double length2 = d.x * d.x + d.y * d.y;
  const double along = (p.x - a.x) * d.x + (p.y - a.y) * d.y;
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  return Distance_px(p, {a.x + t * d.x, a.y + t * d.y});
}

std::uint8_t Mix(std::uint8_t below, std::uint8_t above, double share) {
  return static_cast<std::uint8_t>(std::lround(below + share * (above - below)));
}

// Calls `dash` with the ends of every dash of the line from a to b. `phase_px` is the way gone
// since the line began, and is moved on.
template <typename Dash>
void ForEachDash(PixelPoint a, PixelPoint b, double dash_px, double& phase_px, Dash dash) {
  const double length = Distance_px(a, b);
  const auto at = [&](double s) {
    return PixelPoint{a.x + s / length * (b.x - a.x), a.y + s / length * (b.y - a.y)};
  };
  for (double s = 0.0; s < length;) {
    const double in_period = std::fmod(phase_px + s, 2.0 * dash_px);
    const bool drawn = in_period < dash_px;
    const double rest = (drawn ? dash_px : 2.0 * dash_px) - in_period;
    const double end = std::min(length, s + std::max(rest, 0.01 * dash_px));
    if (drawn) dash(at(s), at(end));
    s = end;
  }
  phase_px += length;
}

}  // namespace

RasterCanvas::RasterCanvas(int width_px, int height_px, Rgb background)
    : image_(width_px, height_px, background), coverage_(image_.pixels().size()) {}

RasterCanvas::PixelRange RasterCanvas::Clip(double left, double top, double right,
                                            double bottom) const {
  const auto clip = [](double value, int end) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(end)));
  };
  return {clip(std::floor(left), image_.width()), clip(std::floor(top), image_.height()),
          clip(std::ceil(right), image_.width()), clip(std::ceil(bottom), image_.height())};
}

void RasterCanvas::FillBox(const Box& box, Rgb color) {
  const PixelRange range =
      Clip(std::round(box.x), std::round(box.y), std::round(box.right()), std::round(box.bottom()));
  for (int y = range.y_begin; y < range.y_end; ++y) {
    for (int x = range.x_begin; x < range.x_end; ++x) image_.At(x, y) = color;
  }
}

void RasterCanvas::CoverSegment(PixelPoint a, PixelPoint b, double half_width_px) {
  const double reach = half_width_px + 0.5;
  const PixelRange range = Clip(std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach,
                                std::max(a.x, b.x) + reach, std::max(a.y, b.y) + reach);
  for (int y = range.y_begin; y < range.y_end; ++y) {
    for (int x = range.x_begin; x < range.x_end; ++x) {
      const double distance = DistanceToSegment_px({x + 0.5, y + 0.5}, a, b);
      const auto share = static_cast<float>(std::clamp(reach - distance, 0.0, 1.0));
      float& covered =
          coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width()) +
                    static_cast<std::size_t>(x)];
      covered = std::max(covered, share);
    }
  }
  const bool first = covered_.x_begin == covered_.x_end;
  covered_.x_begin = first ? range.x_begin : std::min(covered_.x_begin, range.x_begin);
  covered_.y_begin = first ? range.y_begin : std::min(covered_.y_begin, range.y_begin);
  covered_.x_end = std::max(covered_.x_end, range.x_end);
  covered_.y_end = std::max(covered_.y_end, range.y_end);
}

void RasterCanvas::BlendCovered(Rgb color) {
  for (int y = covered_.y_begin; y < covered_.y_end; ++y) {
    for (int x = covered_.x_begin; x < covered_.x_end; ++x) {
      float& share =
          coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width()) +
                    static_cast<std::size_t>(x)];
      Rgb& pixel = image_.At(x, y);
      pixel = {Mix(pixel.red, color.red, share), Mix(pixel.green, color.green, share),
               Mix(pixel.blue, color.blue, share)};
      share = 0.0F;
    }
  }
  covered_ = {};
}

void RasterCanvas::Polyline(std::span<const PixelPoint> points, const Stroke& stroke) {
  const double half_width = 0.5 * stroke.width_px;
  double phase_px = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (!IsFinite(points[i]) || !IsFinite(points[i + 1])) continue;
    if (stroke.dash_px > 0.0) {
      ForEachDash(points[i], points[i + 1], stroke.dash_px, phase_px,
                  [&](PixelPoint a, PixelPoint b) { CoverSegment(a, b, half_width); });
    } else {
      CoverSegment(points[i], points[i + 1], half_width);
    }
  }
  BlendCovered(stroke.color);
}

void RasterCanvas::Disc(PixelPoint center, double radius_px, Rgb color) {
  if (!IsFinite(center)) return;
  CoverSegment(center, center, radius_px);
  BlendCovered(color);
}

void RasterCanvas::Text(PixelPoint baseline, absl::string_view utf8, const TextStyle& style) {
  const double width_px = TextWidth_px(utf8, style.size_px);
  if (style.anchor == Anchor::kMiddle) baseline.x -= 0.5 * width_px;
  if (style.anchor == Anchor::kEnd) baseline.x -= width_px;
  const double half_width = 0.5 * style.size_px * (style.bold ? kBoldPen : kPen);
  for (const std::vector<PixelPoint>& line : WriteText(utf8, style.size_px)) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      CoverSegment({baseline.x + line[i].x, baseline.y + line[i].y},
                   {baseline.x + line[i + 1].x, baseline.y + line[i + 1].y}, half_width);
    }
  }
  BlendCovered(style.color);
}

void RasterCanvas::Picture(const Box& box, const Image& image) {
  if (image.pixels().empty()) return;
  const PixelRange range =
      Clip(std::round(box.x), std::round(box.y), std::round(box.right()), std::round(box.bottom()));
  for (int y = range.y_begin; y < range.y_end; ++y) {
    for (int x = range.x_begin; x < range.x_end; ++x) {
      const double u = (x + 0.5 - box.x) / box.width * image.width();
      const double v = (y + 0.5 - box.y) / box.height * image.height();
      image_.At(x, y) = image.At(std::clamp(static_cast<int>(u), 0, image.width() - 1),
                                 std::clamp(static_cast<int>(v), 0, image.height() - 1));
    }
  }
}

}  // namespace plumescout::lab
