// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "core/occupancy/scan_fit.h"
#include "core/types/byte_archive.h"
#include "core/types/ids.h"

namespace plumescout {

enum class JumpVerdict { kTrusted, kTurnsSuspect, kSuspect, kFitsAgain };

// Notices robots whose poses are wrong by how their scans fit the map, before they are in it.
//
// A scan contradicts the map if 15 % of the beams that can be judged do, some of them by
// ending short of walls and some beyond: people and other robots in the way do the former alone,
// doors that open the latter. Four of the last five scans that can be judged make their robot
// suspect; a robot that is suspect, and whose scans have fitted for three seconds, no more.
// docs/decisions says what was measured. Thread-compatible.
class JumpWatch {
 public:
  // `number` ascends with the robot's scans. Cost: O(1).
  JumpVerdict Note(const RobotId& robot, std::int64_t number, std::int64_t time_ns,
                   const ScanFit& fit);
  // Of a robot that has just turned suspect: the number from which on its poses are in doubt.
  std::int64_t DoubtfulFrom(const RobotId& robot) const;
  bool IsSuspect(const RobotId& robot) const;
  // Its poses are right from that number on, or it says so.
  void Trust(const RobotId& robot, std::int64_t number);

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self) {
    archive(self.robots_);
  }

 private:
  static constexpr std::size_t kWindow = 5;
  static constexpr int kContradicting = 4;
  static constexpr std::int64_t kFitting_ns = 3'000'000'000;

  struct Watched {
    // Of the last kWindow scans that were judged: their numbers, and 1 if they contradicted.
    std::vector<std::int64_t> numbers;
    std::vector<std::uint8_t> contradicts;
    std::int64_t doubtful_from = 0;  // after the last scan before those, or since it was trusted
    bool suspect = false;
    bool fits = false;
    std::int64_t fits_since_ns = 0;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self) {
      auto& [numbers, contradicts, doubtful_from, suspect, fits, fits_since_ns] = self;
      archive(numbers, contradicts, doubtful_from, suspect, fits, fits_since_ns);
      if constexpr (Archive::kReads) {
        archive.Require(numbers.size() == contradicts.size(), "scans were judged without number");
      }
    }
  };

  static JumpVerdict NoteOfSuspect(Watched& watched, bool contradicts, std::int64_t number,
                                   std::int64_t time_ns);
  static void DropFirst(Watched& watched);

  std::map<RobotId, Watched> robots_;
};

}  // namespace plumescout
