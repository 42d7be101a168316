// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart_legend.h"

#include "absl/strings/str_cat.h"
#include "lab/report/font.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr double kNameSize_px = 13.0;
constexpr double kRow_px = 20.0;
constexpr double kBelow_px = 6.0;
constexpr double kBaseline_px = 12.0;  // below the top of a row
constexpr double kSquare_px = 12.0;
constexpr double kLine_px = 24.0;
constexpr double kBeforeName_px = 6.0;
constexpr double kBetween_px = 18.0;

double SampleWidth_px(const ChartLegendItem& item) {
  return item.sample == LegendSample::kLine ? kLine_px : kSquare_px;
}

// Drops the last character, which may have several bytes.
void DropLast(std::string& utf8) {
  const auto continues = [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
  };
  while (!utf8.empty() && continues(utf8.back())) utf8.pop_back();
  if (!utf8.empty()) utf8.pop_back();
}

std::string CutToWidth(const std::string& name, double width_px) {
  constexpr char kCut[] = "...";
  if (TextWidth_px(name, kNameSize_px) <= width_px) return name;
  std::string kept = name;
  while (!kept.empty() && TextWidth_px(absl::StrCat(kept, kCut), kNameSize_px) > width_px) {
    DropLast(kept);
  }
  return absl::StrCat(kept, kCut);
}

struct PlacedItem {
  std::string name;  // as far as it fits
  double x;          // of the sample, from the left edge
  int row;
};

std::vector<PlacedItem> Place(const std::vector<ChartLegendItem>& items, double width_px) {
  std::vector<PlacedItem> placed;
  double x = 0.0;
  int row = 0;
  for (const ChartLegendItem& item : items) {
    const double before_name_px = SampleWidth_px(item) + kBeforeName_px;
    std::string name = CutToWidth(item.name, width_px - before_name_px);
    const double item_px = before_name_px + TextWidth_px(name, kNameSize_px);
    if (x > 0.0 && x + item_px > width_px) {
      x = 0.0;
      ++row;
    }
    placed.push_back({std::move(name), x, row});
    x += item_px + kBetween_px;
  }
  return placed;
}

void DrawSample(Canvas& canvas, PixelPoint baseline, const ChartLegendItem& item) {
  constexpr double kAboveBaseline_px = 10.0;  // of a square
  constexpr double kHalfLetter_px = 4.0;
  const double y = baseline.y - kHalfLetter_px;
  const PixelPoint line[] = {{baseline.x, y}, {baseline.x + kLine_px, y}};
  switch (item.sample) {
    case LegendSample::kLine:
      canvas.Polyline(line, item.stroke);
      return;
    case LegendSample::kSquare:
      canvas.FillBox({baseline.x, baseline.y - kAboveBaseline_px, kSquare_px, kSquare_px},
                     item.stroke.color);
      return;
    case LegendSample::kDot:
      canvas.Disc({baseline.x + 0.5 * kSquare_px, y}, 0.5 * item.stroke.width_px,
                  item.stroke.color);
      return;
  }
}

}  // namespace

double ChartLegendHeight_px(const std::vector<ChartLegendItem>& items, double width_px) {
  if (items.empty()) return 0.0;
  return (Place(items, width_px).back().row + 1) * kRow_px + kBelow_px;
}

void DrawChartLegend(Canvas& canvas, const PixelBox& box,
                     const std::vector<ChartLegendItem>& items) {
  const std::vector<PlacedItem> placed = Place(items, box.width);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const PixelPoint baseline{box.x + placed[i].x, box.y + placed[i].row * kRow_px + kBaseline_px};
    DrawSample(canvas, baseline, items[i]);
    canvas.Text({baseline.x + SampleWidth_px(items[i]) + kBeforeName_px, baseline.y},
                placed[i].name, {kNameSize_px, kInk});
  }
}

}  // namespace plumescout::lab
