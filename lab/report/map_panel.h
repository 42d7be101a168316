// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/types/grid_geometry.h"
#include "core/types/pose2.h"
#include "core/types/rectangle.h"
#include "lab/report/canvas.h"
#include "lab/report/color_scale.h"
#include "lab/report/image.h"

namespace plumescout::lab {

Rectangle RegionOf(const GridGeometry& geometry);

// Cells as an image, one pixel a cell, north up.
struct CellPicture {
  Image image;       // without pixels: nothing to show
  Rectangle region;  // that the image covers
};

// Paints the cells of `geometry` that touch `region`.
CellPicture PaintCells(const GridGeometry& geometry, const Rectangle& region,
                       const std::function<Rgb(Cell)>& color);

struct MapLine {
  std::vector<Point2> points;
  Stroke stroke;
};

enum class MarkShape { kSwatch, kLine, kDisc, kCross };

struct MapMark {
  MarkShape shape = MarkShape::kDisc;
  Rgb color;
  Point2 position;
  // One to three letters: the mark is a disc that they stand in, moved aside if another such disc
  // is in its way, with a line to the place.
  std::string label = {};
  bool stressed = false;  // with a label: a magenta rim in place of the white one
};

struct LegendEntry {
  std::string name;
  MarkShape shape = MarkShape::kSwatch;
  Rgb color;
};

struct ColorBar {
  ColorScale scale;
  std::string unit;
};

// One map with a title, a scale bar and, below it, a colour bar or a legend, or both: then the
// legend has one row.
struct MapPanel {
  std::string title;
  Rectangle region;  // shown
  CellPicture cells;
  std::vector<MapLine> lines;
  std::vector<MapMark> marks;
  std::optional<ColorBar> color_bar;
  std::vector<LegendEntry> legend;
};

// Height that a panel of this width needs for its map to fill the width (bounded for tall maps).
double MapPanelHeight_px(const MapPanel& panel, double width_px);

// Width of its map then: less than the panel's if the map is tall.
double MapWidth_px(const MapPanel& panel, double width_px);

// Draws the panel into the box, as large as it fits.
void DrawMapPanel(Canvas& canvas, const PixelBox& box, const MapPanel& panel);

}  // namespace plumescout::lab
