// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/floor_plan.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

namespace plumescout::lab {
namespace {

constexpr int kMinSide = 14;  // of a room: 2.8 m
constexpr int kMinCorridor = 8;
constexpr int kMaxCorridor = 12;           // 1.6 to 2.4 m
constexpr int kMinLengthForCorridor = 40;  // 8 m: shorter ones are rooms
constexpr int kMinDoor = 5;
constexpr int kMaxDoor = 8;     // 1.0 to 1.6 m
constexpr int kDoorMargin = 2;  // between a door and the end of its wall
constexpr int kHallArea = 45 * kUnitsPerM * kUnitsPerM;

// Divides rectangles into rooms with partitions between them.
class Divider {
 public:
  Divider(const FloorPlanStyle& style, Rng& rng, FloorPlan& plan)
      : style_(style), rng_(rng), plan_(plan) {}

  void Divide(const CellRect& floor) {
    const bool vertical = floor.width() >= floor.height();  // the wall: it crosses the longer side
    const int across = vertical ? floor.width() : floor.height();
    const double limit = style_.largest_room_units2 * rng_.Uniform(2.0 / 3.0, 4.0 / 3.0);
    if (AreaOf(floor) <= limit || across < 2 * kMinSide + 1) {
      const bool hall = AreaOf(floor) >= kHallArea;
      plan_.rooms.push_back({floor, hall ? RoomKind::kHall : RoomKind::kRoom});
      return;
    }
    if (DivideByCorridor(floor, !vertical)) return;
    // Near the middle, so that rooms are not slivers.
    const int slack = std::min(across / 2 - kMinSide, across / 6);
    const int at = across / 2 + DrawInt(rng_, -std::max(0, slack), std::max(0, slack));
    const auto [first, second] = Cut(floor, vertical, at);
    Divide(first);
    Divide(second);
  }

 private:
  // Room, corridor, room, the corridor as long as the floor.
  bool DivideByCorridor(const CellRect& floor, bool vertical) {
    const int across = vertical ? floor.width() : floor.height();
    const int along = vertical ? floor.height() : floor.width();
    const int corridor = DrawInt(rng_, kMinCorridor, kMaxCorridor);
    const int slack = across - corridor - 2 - 2 * kMinSide;
    const bool wanted = rng_.Uniform01() < style_.corridor_share;
    if (!wanted || slack < 0 || along < kMinLengthForCorridor) return false;
    const auto [first, rest] = Cut(floor, vertical, kMinSide + DrawInt(rng_, 0, slack));
    const auto [middle, second] = Cut(rest, vertical, corridor);
    plan_.rooms.push_back({middle, RoomKind::kCorridor});
    Divide(first);
    Divide(second);
    return true;
  }

  // A partition `at` units into the floor, and what lies before and behind it.
  std::pair<CellRect, CellRect> Cut(const CellRect& floor, bool vertical, int at) {
    CellRect before = floor;
    CellRect wall = floor;
    CellRect behind = floor;
    if (vertical) {
      before.end.x = wall.min.x = floor.min.x + at;
      behind.min.x = wall.end.x = wall.min.x + 1;
    } else {
      before.end.y = wall.min.y = floor.min.y + at;
      behind.min.y = wall.end.y = wall.min.y + 1;
    }
    plan_.partitions.push_back({wall, vertical, {}});
    return {before, behind};
  }

  const FloorPlanStyle& style_;
  Rng& rng_;
  FloorPlan& plan_;
};

// Two rooms on both sides of a partition, and the stretch that they share, less the margins.
struct SharedWall {
  int partition = 0;
  int room_a = 0;
  int room_b = 0;
  int from = 0;
  int to = 0;
};

// Units from `from` up to but without `to`.
struct Span {
  int from = 0;
  int to = 0;
};

Span Along(const Partition& wall, const CellRect& rect) {
  return wall.vertical ? Span{rect.min.y, rect.end.y} : Span{rect.min.x, rect.end.x};
}
Span Across(const Partition& wall, const CellRect& rect) {
  return wall.vertical ? Span{rect.min.x, rect.end.x} : Span{rect.min.y, rect.end.y};
}

std::vector<SharedWall> SharedWalls(const FloorPlan& plan) {
  std::vector<SharedWall> shared;
  for (std::size_t p = 0; p < plan.partitions.size(); ++p) {
    const Partition& wall = plan.partitions[p];
    const Span thickness = Across(wall, wall.solid);
    const Span length = Along(wall, wall.solid);
    for (std::size_t a = 0; a < plan.rooms.size(); ++a) {
      if (Across(wall, plan.rooms[a].floor).to != thickness.from) continue;
      const Span before = Along(wall, plan.rooms[a].floor);
      for (std::size_t b = 0; b < plan.rooms.size(); ++b) {
        if (Across(wall, plan.rooms[b].floor).from != thickness.to) continue;
        const Span behind = Along(wall, plan.rooms[b].floor);
        const int from = std::max({before.from, behind.from, length.from}) + kDoorMargin;
        const int to = std::min({before.to, behind.to, length.to}) - kDoorMargin;
        if (to - from < kMinDoor) continue;
        shared.push_back({static_cast<int>(p), static_cast<int>(a), static_cast<int>(b), from, to});
      }
    }
  }
  return shared;
}

void CutDoor(const SharedWall& shared, Rng& rng, FloorPlan& plan) {
  const int width = DrawInt(rng, kMinDoor, std::min(kMaxDoor, shared.to - shared.from));
  const int from = DrawInt(rng, shared.from, shared.to - width);
  plan.partitions[static_cast<std::size_t>(shared.partition)].doors.push_back(
      {from, width, shared.room_a, shared.room_b});
}

// Rooms that are connected have the same root.
class RoomGroups {
 public:
  explicit RoomGroups(std::size_t rooms) : parent_(rooms), groups_(rooms) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  // Whether that connected what was apart.
  bool Connect(int a, int b) {
    const int root_a = Root(a);
    const int root_b = Root(b);
    if (root_a == root_b) return false;
    parent_[static_cast<std::size_t>(root_b)] = root_a;
    --groups_;
    return true;
  }
  bool IsOne() const { return groups_ == 1; }

 private:
  int Root(int room) const {
    while (parent_[static_cast<std::size_t>(room)] != room) {
      room = parent_[static_cast<std::size_t>(room)];
    }
    return room;
  }

  std::vector<int> parent_;
  std::size_t groups_;
};

// Doors to corridors first: that is what they are for.
void ShuffleCorridorsFirst(const FloorPlan& plan, Rng& rng, std::vector<SharedWall>& shared) {
  for (std::size_t i = shared.size(); i > 1; --i) {
    std::swap(shared[i - 1], shared[rng.Below(i)]);
  }
  const auto at_corridor = [&plan](const SharedWall& wall) {
    return plan.rooms[static_cast<std::size_t>(wall.room_a)].kind == RoomKind::kCorridor ||
           plan.rooms[static_cast<std::size_t>(wall.room_b)].kind == RoomKind::kCorridor;
  };
  std::stable_partition(shared.begin(), shared.end(), at_corridor);
}

// Whether every room can be reached then.
bool CutDoors(double loop_share, Rng& rng, FloorPlan& plan) {
  std::vector<SharedWall> shared = SharedWalls(plan);
  ShuffleCorridorsFirst(plan, rng, shared);
  RoomGroups groups(plan.rooms.size());
  for (const SharedWall& wall : shared) {
    const bool needed = groups.Connect(wall.room_a, wall.room_b);
    if (needed || rng.Uniform01() < loop_share) CutDoor(wall, rng, plan);
  }
  return groups.IsOne();
}

}  // namespace

int DrawInt(Rng& rng, int low, int high) {
  return low + static_cast<int>(rng.Below(static_cast<std::uint64_t>(high - low) + 1));
}

std::optional<FloorPlan> DrawFloorPlan(int width, int height, const FloorPlanStyle& style,
                                       Rng& rng) {
  FloorPlan plan;
  plan.width = width;
  plan.height = height;
  Divider(style, rng, plan).Divide({{1, 1}, {width - 1, height - 1}});
  if (!CutDoors(style.loop_share, rng, plan)) return std::nullopt;
  return plan;
}

}  // namespace plumescout::lab
