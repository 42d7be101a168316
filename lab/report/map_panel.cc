// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/map_panel.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "lab/report/disc_layout.h"
#include "lab/report/font.h"
#include "lab/report/palette.h"
#include "lab/report/ticks.h"

namespace plumescout::lab {
namespace {

constexpr double kTitleSize_px = 16.0;
constexpr double kLabelSize_px = 12.0;
constexpr double kTop_px = 34.0;     // for the title
constexpr double kBottom_px = 76.0;  // for colour bar or legend
constexpr double kMaxMapHeight_px = 640.0;
constexpr double kBeforeUnit_px = 8.0;  // between colour bar and unit
constexpr double kHalo_px = 1.5;        // white rim of marks, which sets them off any colour

// Where the map lies on the canvas.
struct MapFrame {
  PixelBox box;
  Rectangle region;
  double px_per_m;

  PixelPoint ToPixel(Point2 point) const {
    return {box.x + (point.x_m - region.min.x_m) * px_per_m,
            box.bottom() - (point.y_m - region.min.y_m) * px_per_m};
  }
};

// The largest map that fits, at the left.
MapFrame FitMap(const PixelBox& box, const Rectangle& region) {
  const double height_px = box.height - kTop_px - kBottom_px;
  const double px_per_m = std::min(box.width / region.width_m(), height_px / region.height_m());
  return {{box.x, box.y + kTop_px, px_per_m * region.width_m(), px_per_m * region.height_m()},
          region,
          px_per_m};
}

void DrawOutline(Canvas& canvas, const PixelBox& box) {
  const PixelPoint outline[] = {{box.x, box.y},
                                {box.right(), box.y},
                                {box.right(), box.bottom()},
                                {box.x, box.bottom()},
                                {box.x, box.y}};
  canvas.Polyline(outline, {kFrame, 1.0});
}

// The title and, in line with it, a bar of a round number of metres: over the right edge of the
// map, or as far beyond it as the title needs.
void DrawTitleAndScaleBar(Canvas& canvas, const PixelBox& box, const std::string& title,
                          const MapFrame& frame) {
  constexpr double kLargestShare = 0.2;  // of the map's width
  constexpr double kEnd_px = 4.0;        // half the height of its ends
  constexpr double kBeforeBar_px = 8.0;
  constexpr double kAfterTitle_px = 16.0;
  const double length_m = RoundDown125(kLargestShare * frame.region.width_m());
  const std::string label = absl::StrCat(TickLabel(length_m), " m");
  const double length_px = length_m * frame.px_per_m;
  const double behind_title_px = (title.empty() ? 0.0 : kAfterTitle_px) +
                                 TextWidth_px(label, kLabelSize_px) + kBeforeBar_px + length_px;
  const double size_px = SizeToFit_px(title, kTitleSize_px, box.width - behind_title_px, true);
  canvas.Text({box.x, box.y + kTitleSize_px}, title, {size_px, kInk, Anchor::kStart, true});
  const double after_title = box.x + TextWidth_px(title, size_px, true) + behind_title_px;
  const double right = std::max(frame.box.right(), after_title);
  const double left = right - length_px;
  const double y = box.y + kTitleSize_px - kEnd_px - 1.0;
  const PixelPoint bar[] = {{left, y - kEnd_px}, {left, y + kEnd_px},  {left, y},
                            {right, y},          {right, y - kEnd_px}, {right, y + kEnd_px}};
  canvas.Polyline(bar, {kInk, 1.5});
  canvas.Text({left - kBeforeBar_px, y + kEnd_px + 1.0}, label,
              {kLabelSize_px, kInk, Anchor::kEnd});
}

void DrawCells(Canvas& canvas, const MapFrame& frame, const CellPicture& cells) {
  const PixelPoint south_west = frame.ToPixel(cells.region.min);
  const PixelPoint north_east = frame.ToPixel(cells.region.max);
  canvas.Picture(
      {south_west.x, north_east.y, north_east.x - south_west.x, south_west.y - north_east.y},
      cells.image);
}

void DrawCross(Canvas& canvas, PixelPoint center, Rgb color) {
  constexpr double kArm_px = 5.0;
  const PixelPoint falling[] = {{center.x - kArm_px, center.y - kArm_px},
                                {center.x + kArm_px, center.y + kArm_px}};
  const PixelPoint rising[] = {{center.x - kArm_px, center.y + kArm_px},
                               {center.x + kArm_px, center.y - kArm_px}};
  constexpr double kWidth_px = 3.0;
  for (const Stroke& stroke :
       {Stroke{kPaper, kWidth_px + 2.0 * kHalo_px}, Stroke{color, kWidth_px}}) {
    canvas.Polyline(falling, stroke);
    canvas.Polyline(rising, stroke);
  }
}

void DrawMark(Canvas& canvas, MarkShape shape, PixelPoint center, Rgb color) {
  constexpr double kRadius_px = 4.0;
  constexpr double kHalfLine_px = 9.0;
  switch (shape) {
    case MarkShape::kSwatch:
      canvas.FillBox({center.x - 6.0, center.y - 6.0, 12.0, 12.0}, kFrame);
      canvas.FillBox({center.x - 5.0, center.y - 5.0, 10.0, 10.0}, color);
      return;
    case MarkShape::kLine: {
      const PixelPoint line[] = {{center.x - kHalfLine_px, center.y},
                                 {center.x + kHalfLine_px, center.y}};
      canvas.Polyline(line, {color, 2.0});
      return;
    }
    case MarkShape::kDisc:
      canvas.Disc(center, kRadius_px + kHalo_px, kPaper);
      canvas.Disc(center, kRadius_px, color);
      return;
    case MarkShape::kCross:
      DrawCross(canvas, center, color);
      return;
  }
}

// Ink that can be read on the colour.
Rgb InkOn(Rgb color) {
  constexpr double kLightFrom = 150.0;  // luma, [0, 255]
  const double luma = 0.299 * color.red + 0.587 * color.green + 0.114 * color.blue;
  return luma > kLightFrom ? kInk : kPaper;
}

void DrawLabels(Canvas& canvas, const MapFrame& frame, const std::vector<MapMark>& marks) {
  constexpr double kRadius_px = 9.0;
  constexpr double kTextSize_px = 12.0;
  std::vector<MapMark> labelled;
  std::vector<PixelPoint> places;
  for (const MapMark& mark : marks) {
    if (mark.label.empty()) continue;
    labelled.push_back(mark);
    places.push_back(frame.ToPixel(mark.position));
  }
  const std::vector<PixelPoint> centers = SpreadDiscs(places, kRadius_px + kHalo_px, frame.box);
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    const PixelPoint leader[] = {places[i], centers[i]};
    canvas.Polyline(leader, {kInk, 1.2});
    canvas.Disc(places[i], 2.0, kInk);
  }
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    const bool stressed = labelled[i].stressed;
    canvas.Disc(centers[i], kRadius_px + (stressed ? 2.0 : 1.0) * kHalo_px,
                stressed ? kSourceColor : kPaper);
    canvas.Disc(centers[i], kRadius_px, labelled[i].color);
    constexpr double kHalfCapital = 0.36;  // of the size of the font
    canvas.Text({centers[i].x, centers[i].y + kHalfCapital * kTextSize_px}, labelled[i].label,
                {kTextSize_px, InkOn(labelled[i].color), Anchor::kMiddle, true});
  }
}

void DrawColorBar(Canvas& canvas, const PixelBox& box, const ColorBar& bar) {
  constexpr int kSteps = 256;
  Image strip(kSteps, 1);
  for (int i = 0; i < kSteps; ++i) {
    strip.At(i, 0) = ColorAt(bar.scale.map, i / static_cast<double>(kSteps - 1));
  }
  canvas.Picture(box, strip);
  DrawOutline(canvas, box);
  constexpr int kTicks = 4;
  const std::vector<double> ticks = bar.scale.logarithmic
                                        ? DecadeTicks(bar.scale.low, bar.scale.high)
                                        : LinearTicks(bar.scale.low, bar.scale.high, kTicks);
  for (const double value : ticks) {
    const double x = box.x + bar.scale.Share(value) * box.width;
    const PixelPoint tick[] = {{x, box.bottom()}, {x, box.bottom() + 4.0}};
    canvas.Polyline(tick, {kFrame, 1.0});
    canvas.Text({x, box.bottom() + 18.0}, TickLabel(value),
                {kLabelSize_px, kFaintInk, Anchor::kMiddle});
  }
  canvas.Text({box.right() + kBeforeUnit_px, box.bottom() - 2.0}, bar.unit,
              {kLabelSize_px, kInk, Anchor::kStart});
}

// Entries one after the other, in rows; in one row, as small as it takes, if `one_row`.
void DrawLegend(Canvas& canvas, const PixelBox& box, const std::vector<LegendEntry>& legend,
                bool one_row) {
  constexpr double kRow_px = 20.0;
  constexpr double kMark_px = 10.0;  // centre of the mark
  constexpr double kName_px = 24.0;
  constexpr double kBetween_px = 16.0;
  const auto width_px = [](const LegendEntry& entry) {
    return kName_px + TextWidth_px(entry.name, kLabelSize_px) + kBetween_px;
  };
  double all_px = -kBetween_px;
  for (const LegendEntry& entry : legend) all_px += width_px(entry);
  const double scale = one_row && all_px > box.width ? box.width / all_px : 1.0;
  double x = 0.0;
  double y = box.y + 6.0;
  for (const LegendEntry& entry : legend) {
    if (!one_row && x > 0.0 && x + width_px(entry) - kBetween_px > box.width) {
      x = 0.0;
      y += kRow_px;
    }
    DrawMark(canvas, entry.shape, {box.x + x + scale * kMark_px, y}, entry.color);
    canvas.Text({box.x + x + scale * kName_px, y + 4.0}, entry.name,
                {scale * kLabelSize_px, kInk, Anchor::kStart});
    x += scale * width_px(entry);
  }
}

}  // namespace

Rectangle RegionOf(const GridGeometry& geometry) {
  return {{geometry.origin_x_m, geometry.origin_y_m},
          {geometry.origin_x_m + geometry.width * geometry.resolution_m,
           geometry.origin_y_m + geometry.height * geometry.resolution_m}};
}

CellPicture PaintCells(const GridGeometry& geometry, const Rectangle& region,
                       const std::function<Rgb(Cell)>& color) {
  const double inset_m = 1e-6 * geometry.resolution_m;  // an edge touched by rounding is not shown
  Cell first = geometry.CellAt({region.min.x_m + inset_m, region.min.y_m + inset_m});
  Cell last = geometry.CellAt({region.max.x_m - inset_m, region.max.y_m - inset_m});
  first = {std::max(first.x, 0), std::max(first.y, 0)};
  last = {std::min(last.x, geometry.width - 1), std::min(last.y, geometry.height - 1)};
  if (last.x < first.x || last.y < first.y) return {};
  GridGeometry part = geometry;
  part.origin_x_m += first.x * geometry.resolution_m;
  part.origin_y_m += first.y * geometry.resolution_m;
  part.width = last.x - first.x + 1;
  part.height = last.y - first.y + 1;
  CellPicture picture{Image(part.width, part.height), RegionOf(part)};
  for (int y = 0; y < part.height; ++y) {
    for (int x = 0; x < part.width; ++x) {
      picture.image.At(x, part.height - 1 - y) = color({first.x + x, first.y + y});
    }
  }
  return picture;
}

double MapPanelHeight_px(const MapPanel& panel, double width_px) {
  const double map_px = width_px / panel.region.width_m() * panel.region.height_m();
  return kTop_px + std::min(map_px, kMaxMapHeight_px) + kBottom_px;
}

double MapWidth_px(const MapPanel& panel, double width_px) {
  return std::min(width_px, kMaxMapHeight_px / panel.region.height_m() * panel.region.width_m());
}

void DrawMapPanel(Canvas& canvas, const PixelBox& box, const MapPanel& panel) {
  const MapFrame frame = FitMap(box, panel.region);
  DrawTitleAndScaleBar(canvas, box, panel.title, frame);
  canvas.FillBox(frame.box, kUnknownColor);
  DrawCells(canvas, frame, panel.cells);
  for (const MapLine& line : panel.lines) {
    std::vector<PixelPoint> points;
    for (const Point2& point : line.points) points.push_back(frame.ToPixel(point));
    canvas.Polyline(points, line.stroke);
  }
  for (const MapMark& mark : panel.marks) {
    if (mark.label.empty()) {
      DrawMark(canvas, mark.shape, frame.ToPixel(mark.position), mark.color);
    }
  }
  DrawLabels(canvas, frame, panel.marks);
  DrawOutline(canvas, frame.box);
  double below = frame.box.bottom() + 14.0;
  if (panel.color_bar) {
    constexpr double kLeastUnitRoom_px = 48.0;  // bars of short units are equally long
    const double unit_px = TextWidth_px(panel.color_bar->unit, kLabelSize_px) + kBeforeUnit_px;
    const double bar_px = frame.box.width - std::max(kLeastUnitRoom_px, unit_px);
    DrawColorBar(canvas, {frame.box.x, below, bar_px, 12.0}, *panel.color_bar);
    constexpr double kBarAndTicks_px = 38.0;
    below += kBarAndTicks_px;
  }
  DrawLegend(canvas, {frame.box.x, below, box.width, kBottom_px}, panel.legend,
             panel.color_bar.has_value());
}

}  // namespace plumescout::lab
