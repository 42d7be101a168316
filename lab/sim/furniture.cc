// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/furniture.h"

#include <algorithm>

namespace plumescout::lab {
namespace {

constexpr int kTries = 12;  // to find a place for one piece
constexpr int kUnits2PerM2 = kUnitsPerM * kUnitsPerM;

class Furnisher {
 public:
  Furnisher(const std::vector<CellRect>& clear, Rng& rng) : clear_(clear), rng_(rng) {}

  void Furnish(const Room& room) {
    switch (room.kind) {
      case RoomKind::kRoom:
        return FurnishRoom(room.floor);
      case RoomKind::kHall:
        return FurnishHall(room.floor);
      case RoomKind::kCorridor:
        return FurnishCorridor(room.floor);
    }
  }

  std::vector<CellRect> TakePieces() { return std::move(pieces_); }

 private:
  void FurnishRoom(const CellRect& floor) {
    constexpr int kAreaPerPiece = 7 * kUnits2PerM2;
    const int pieces = DrawInt(rng_, 1, std::max(1, AreaOf(floor) / kAreaPerPiece));
    for (int i = 0; i < pieces; ++i) {
      if (rng_.Below(3) == 0) {
        PlaceFree(floor, DrawInt(rng_, 3, 5), DrawInt(rng_, 6, 9));  // a table
      } else {
        PlaceAtWall(floor, DrawInt(rng_, 2, 3), DrawInt(rng_, 5, 12));  // a shelf
      }
    }
  }

  void FurnishHall(const CellRect& floor) {
    constexpr int kAreaPerContainer = 13 * kUnits2PerM2;
    const int containers = AreaOf(floor) / kAreaPerContainer;
    switch (rng_.Below(3)) {
      case 0:
        for (int i = 0; i < containers; ++i) PlaceContainer(floor);
        return;
      case 1:
        PlacePillars(floor);
        for (int i = 0; i < containers / 2; ++i) PlaceContainer(floor);
        for (int i = 0; i < 3; ++i) PlaceAtWall(floor, 3, DrawInt(rng_, 6, 16));
        return;
      default:
        PlaceShelfRows(floor);
        for (int i = 0; i < containers / 4; ++i) PlaceContainer(floor);
        return;
    }
  }

  void FurnishCorridor(const CellRect& floor) {
    constexpr int kDepth = 2;
    const bool wide = std::min(floor.width(), floor.height()) >= kDepth + 2 * kPassage_units;
    if (wide && rng_.Below(2) == 0) PlaceAtWall(floor, kDepth, DrawInt(rng_, 4, 6));
  }

  // 1.2 m x 2.4 m, give or take.
  void PlaceContainer(const CellRect& floor) {
    PlaceFree(floor, DrawInt(rng_, 5, 7), DrawInt(rng_, 8, 13));
  }

  // In a grid of 3 to 4 m, 0.4 m thick.
  void PlacePillars(const CellRect& floor) {
    constexpr int kSide = 2;
    const int step = DrawInt(rng_, 15, 20);
    for (int x = floor.min.x + step / 2; x < floor.end.x; x += step) {
      for (int y = floor.min.y + step / 2; y < floor.end.y; y += step) {
        TryPlace(floor, CellRect::Sized({x, y}, kSide, kSide));
      }
    }
  }

  // Long rows along the longer side with aisles of 1.2 to 2 m, broken in the middle.
  void PlaceShelfRows(const CellRect& floor) {
    constexpr int kDepth = 4;
    constexpr int kEnds = 7;  // room at both ends of a row
    const bool east = floor.width() >= floor.height();
    const int aisle = DrawInt(rng_, 6, 10);
    const int begin = (east ? floor.min.x : floor.min.y) + kEnds;
    const int end = (east ? floor.end.x : floor.end.y) - kEnds;
    const int gap = DrawInt(rng_, begin + kEnds, std::max(begin + kEnds, end - 2 * kEnds));
    const int last = (east ? floor.end.y : floor.end.x) - kDepth - kPassage_units;
    for (int at = (east ? floor.min.y : floor.min.x) + aisle; at <= last; at += kDepth + aisle) {
      TryPlaceRow(floor, east, {{begin, at}, {gap, at + kDepth}});
      TryPlaceRow(floor, east, {{gap + kEnds, at}, {end, at + kDepth}});
    }
  }

  // `row` runs along x; if not `east` it is turned to run along y.
  void TryPlaceRow(const CellRect& floor, bool east, const CellRect& row) {
    constexpr int kShortest = 5;
    if (row.width() < kShortest) return;
    TryPlace(floor, east ? row : CellRect{{row.min.y, row.min.x}, {row.end.y, row.end.x}});
  }

  void PlaceFree(const CellRect& floor, int a, int b) {
    const bool turned = rng_.Below(2) == 0;
    const int width = turned ? a : b;
    const int height = turned ? b : a;
    const int room_x = floor.width() - width;
    const int room_y = floor.height() - height;
    if (room_x < 0 || room_y < 0) return;
    for (int i = 0; i < kTries; ++i) {
      const int x = floor.min.x + DrawInt(rng_, 0, room_x);
      const int y = floor.min.y + DrawInt(rng_, 0, room_y);
      if (TryPlace(floor, CellRect::Sized({x, y}, width, height))) return;
    }
  }

  void PlaceAtWall(const CellRect& floor, int depth, int wanted_length) {
    for (int i = 0; i < kTries; ++i) {
      const bool east = rng_.Below(2) == 0;  // the wall runs east
      const bool low = rng_.Below(2) == 0;   // south or west of the room
      const int side = east ? floor.width() : floor.height();
      const int length = std::min(wanted_length, side);
      const int along = (east ? floor.min.x : floor.min.y) + DrawInt(rng_, 0, side - length);
      const int first = east ? floor.min.y : floor.min.x;
      const int last = (east ? floor.end.y : floor.end.x) - depth;
      const int at = low ? first : last;
      const CellRect piece = east ? CellRect::Sized({along, at}, length, depth)
                                  : CellRect::Sized({at, along}, depth, length);
      if (TryPlace(floor, piece)) return;
    }
  }

  bool TryPlace(const CellRect& floor, const CellRect& piece) {
    const auto touches_or_passes = [](int gap) { return gap == 0 || gap >= kPassage_units; };
    const bool fits = touches_or_passes(piece.min.x - floor.min.x) &&
                      touches_or_passes(piece.min.y - floor.min.y) &&
                      touches_or_passes(floor.end.x - piece.end.x) &&
                      touches_or_passes(floor.end.y - piece.end.y);
    if (!fits) return false;
    const auto in_the_way = [](const CellRect& rect) {
      return [rect](const CellRect& other) { return other.Overlaps(rect); };
    };
    if (std::any_of(clear_.begin(), clear_.end(), in_the_way(piece))) return false;
    const CellRect reach = piece.Grown(kPassage_units);
    if (std::any_of(pieces_.begin(), pieces_.end(), in_the_way(reach))) return false;
    pieces_.push_back(piece);
    return true;
  }

  const std::vector<CellRect>& clear_;
  Rng& rng_;
  std::vector<CellRect> pieces_;
};

}  // namespace

std::vector<CellRect> DrawFurniture(const FloorPlan& plan, const std::vector<CellRect>& clear,
                                    Rng& rng) {
  Furnisher furnisher(clear, rng);
  for (const Room& room : plan.rooms) furnisher.Furnish(room);
  return furnisher.TakePieces();
}

}  // namespace plumescout::lab
