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
  Furnisher(const std::vector<UnitRect>& clear, Rng& rng) : clear_(clear), rng_(rng) {}

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

  std::vector<UnitRect> TakePieces() { return std::move(pieces_); }

 private:
  void FurnishRoom(const UnitRect& floor) {
    constexpr int kAreaPerPiece = 7 * kUnits2PerM2;
    const int pieces = DrawInt(rng_, 1, std::max(1, floor.area() / kAreaPerPiece));
    for (int i = 0; i < pieces; ++i) {
      if (rng_.Below(3) == 0) {
        PlaceFree(floor, DrawInt(rng_, 3, 5), DrawInt(rng_, 6, 9));  // a table
      } else {
        PlaceAtWall(floor, DrawInt(rng_, 2, 3), DrawInt(rng_, 5, 12));  // a shelf
      }
    }
  }

  void FurnishHall(const UnitRect& floor) {
    constexpr int kAreaPerContainer = 13 * kUnits2PerM2;
    const int containers = floor.area() / kAreaPerContainer;
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

  void FurnishCorridor(const UnitRect& floor) {
    constexpr int kDepth = 2;
    const bool wide = std::min(floor.width(), floor.height()) >= kDepth + 2 * kPassage_units;
    if (wide && rng_.Below(2) == 0) PlaceAtWall(floor, kDepth, DrawInt(rng_, 4, 6));
  }

  // 1.2 m x 2.4 m, give or take.
  void PlaceContainer(const UnitRect& floor) {
    PlaceFree(floor, DrawInt(rng_, 5, 7), DrawInt(rng_, 8, 13));
  }

  // In a grid of 3 to 4 m, 0.4 m thick.
  void PlacePillars(const UnitRect& floor) {
    constexpr int kSide = 2;
    const int step = DrawInt(rng_, 15, 20);
    for (int x = floor.x0 + step / 2; x < floor.x1; x += step) {
      for (int y = floor.y0 + step / 2; y < floor.y1; y += step) {
        TryPlace(floor, {x, y, x + kSide, y + kSide});
      }
    }
  }

  // Long rows along the longer side with aisles of 1.2 to 2 m, broken in the middle.
  void PlaceShelfRows(const UnitRect& floor) {
    constexpr int kDepth = 4;
    constexpr int kEnds = 7;  // room at both ends of a row
    const bool east = floor.width() >= floor.height();
    const int aisle = DrawInt(rng_, 6, 10);
    const int begin = (east ? floor.x0 : floor.y0) + kEnds;
    const int end = (east ? floor.x1 : floor.y1) - kEnds;
    const int gap = DrawInt(rng_, begin + kEnds, std::max(begin + kEnds, end - 2 * kEnds));
    const int last = (east ? floor.y1 : floor.x1) - kDepth - kPassage_units;
    for (int at = (east ? floor.y0 : floor.x0) + aisle; at <= last; at += kDepth + aisle) {
      TryPlaceRow(floor, east, {begin, at, gap, at + kDepth});
      TryPlaceRow(floor, east, {gap + kEnds, at, end, at + kDepth});
    }
  }

  // `row` runs along x; if not `east` it is turned to run along y.
  void TryPlaceRow(const UnitRect& floor, bool east, const UnitRect& row) {
    constexpr int kShortest = 5;
    if (row.width() < kShortest) return;
    TryPlace(floor, east ? row : UnitRect{row.y0, row.x0, row.y1, row.x1});
  }

  void PlaceFree(const UnitRect& floor, int a, int b) {
    const bool turned = rng_.Below(2) == 0;
    const int width = turned ? a : b;
    const int height = turned ? b : a;
    const int room_x = floor.width() - width;
    const int room_y = floor.height() - height;
    if (room_x < 0 || room_y < 0) return;
    for (int i = 0; i < kTries; ++i) {
      const int x = floor.x0 + DrawInt(rng_, 0, room_x);
      const int y = floor.y0 + DrawInt(rng_, 0, room_y);
      if (TryPlace(floor, {x, y, x + width, y + height})) return;
    }
  }

  void PlaceAtWall(const UnitRect& floor, int depth, int wanted_length) {
    for (int i = 0; i < kTries; ++i) {
      const bool east = rng_.Below(2) == 0;  // the wall runs east
      const bool low = rng_.Below(2) == 0;   // south or west of the room
      const int side = east ? floor.width() : floor.height();
      const int length = std::min(wanted_length, side);
      const int along = (east ? floor.x0 : floor.y0) + DrawInt(rng_, 0, side - length);
      const int first = east ? floor.y0 : floor.x0;
      const int last = (east ? floor.y1 : floor.x1) - depth;
      const int at = low ? first : last;
      const UnitRect piece = east ? UnitRect{along, at, along + length, at + depth}
                                  : UnitRect{at, along, at + depth, along + length};
      if (TryPlace(floor, piece)) return;
    }
  }

  bool TryPlace(const UnitRect& floor, const UnitRect& piece) {
    const auto touches_or_passes = [](int gap) { return gap == 0 || gap >= kPassage_units; };
    const bool fits =
        touches_or_passes(piece.x0 - floor.x0) && touches_or_passes(piece.y0 - floor.y0) &&
        touches_or_passes(floor.x1 - piece.x1) && touches_or_passes(floor.y1 - piece.y1);
    if (!fits) return false;
    const auto in_the_way = [](const UnitRect& rect) {
      return [rect](const UnitRect& other) { return other.Overlaps(rect); };
    };
    if (std::any_of(clear_.begin(), clear_.end(), in_the_way(piece))) return false;
    const UnitRect reach = piece.Grown(kPassage_units);
    if (std::any_of(pieces_.begin(), pieces_.end(), in_the_way(reach))) return false;
    pieces_.push_back(piece);
    return true;
  }

  const std::vector<UnitRect>& clear_;
  Rng& rng_;
  std::vector<UnitRect> pieces_;
};

}  // namespace

std::vector<UnitRect> DrawFurniture(const FloorPlan& plan, const std::vector<UnitRect>& clear,
                                    Rng& rng) {
  Furnisher furnisher(clear, rng);
  for (const Room& room : plan.rooms) furnisher.Furnish(room);
  return furnisher.TakePieces();
}

}  // namespace plumescout::lab
