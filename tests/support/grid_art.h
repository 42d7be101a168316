// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout::testing {

// Maps drawn as text. The first string is the northmost row, so a picture reads like a map:
//   '#' occupied, '?' unknown, any other character free ('.', or letters that mark cells).
using GridArt = std::vector<std::string>;

inline GridGeometry GeometryOfArt(const GridArt& art, double resolution_m = 0.1) {
  GridGeometry geometry;
  geometry.resolution_m = resolution_m;
  geometry.width = art.empty() ? 0 : static_cast<int>(art.front().size());
  geometry.height = static_cast<int>(art.size());
  return geometry;
}

inline char ArtAt(const GridArt& art, Cell cell) {
  return art.at(art.size() - 1 - static_cast<std::size_t>(cell.y))
      .at(static_cast<std::size_t>(cell.x));
}

inline CellState StateOfChar(char c) {
  if (c == '#') return CellState::kOccupied;
  return c == '?' ? CellState::kUnknown : CellState::kFree;
}

inline Grid<CellState> GridFromArt(const GridArt& art, double resolution_m = 0.1) {
  Grid<CellState> grid(GeometryOfArt(art, resolution_m));
  for (std::size_t i = 0; i < grid.size(); ++i) {
    grid[i] = StateOfChar(ArtAt(art, grid.geometry().CellAtIndex(i)));
  }
  return grid;
}

// 1 where the character is none of `zeros`, else 0.
inline Grid<std::uint8_t> MaskFromArt(const GridArt& art, const std::string& zeros = "#?",
                                      double resolution_m = 0.1) {
  Grid<std::uint8_t> mask(GeometryOfArt(art, resolution_m));
  for (std::size_t i = 0; i < mask.size(); ++i) {
    mask[i] = zeros.find(ArtAt(art, mask.geometry().CellAtIndex(i))) == std::string::npos ? 1 : 0;
  }
  return mask;
}

// Cells drawn with `mark`, row by row from the south-west.
inline std::vector<Cell> CellsInArt(const GridArt& art, char mark) {
  std::vector<Cell> cells;
  const GridGeometry geometry = GeometryOfArt(art);
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    if (ArtAt(art, geometry.CellAtIndex(i)) == mark) cells.push_back(geometry.CellAtIndex(i));
  }
  return cells;
}

// The one cell drawn with `mark`.
inline Cell CellInArt(const GridArt& art, char mark) { return CellsInArt(art, mark).at(0); }

// A mask drawn as text, '#' where non-zero, for messages of failed expectations.
inline std::string ArtFromMask(const Grid<std::uint8_t>& mask) {
  std::string art;
  for (int y = mask.height() - 1; y >= 0; --y) {
    for (int x = 0; x < mask.width(); ++x) art += mask[Cell{x, y}] != 0 ? '#' : '.';
    art += '\n';
  }
  return art;
}

}  // namespace plumescout::testing
