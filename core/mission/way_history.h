// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/belief/sampled_cells.h"
#include "core/gas/reading_store.h"
#include "core/gas/sensor_offsets.h"
#include "core/mission/map_rebuild.h"
#include "core/mission/packed_scan.h"
#include "core/mission/way_correction.h"
#include "core/occupancy/occupancy_grid.h"
#include "core/types/gas_reading.h"
#include "core/types/gas_sensor.h"
#include "core/types/ids.h"
#include "core/types/observation.h"
#include "core/types/options.h"

namespace plumescout {

// What robots measured, and where they held themselves to be, so that both can be put right later:
// every gas reading, 136 bytes each, and key scans, 104 + 160 bytes and two a beam. A scan is a key
// scan if its robot has moved by 0.1 m, turned by 5 degrees or stood for a second since its last
// one; one that is none counts as another of that. Poses are in frame map.
//
// When it is told to hold less, what is oldest is merged into a map and a store of readings, as it
// then is: that cannot be corrected any more. Entries of robots whose poses are in doubt are in
// quarantine: they are kept, but count for nothing. Thread-compatible.
class WayHistory {
 public:
  // REQUIRES: Validate(options).ok().
  explicit WayHistory(const MissionOptions& options);

  // The mission that it is of was restored without a history: all that came before is as it is.
  void BeginWith(const OccupancyGrid& map, const ReadingStore& readings,
                 const SampledCells& sampled, std::int64_t time_ns);

  bool keeps() const { return keeps_; }
  // Of the next entry; entries are numbered in the order in which they come.
  std::int64_t next_number() const { return next_number_; }

  void AddReading(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                  const GasReading& reading, bool quarantined, const GasSensor& sensor = {},
                  std::size_t species = 0, bool is_part = false);
  void AddScan(const RobotId& robot, std::int64_t time_ns, const Pose2& pose, const Scan& scan,
               const std::vector<MaskDisc>& masks, bool quarantined);

  // Puts the robot's entries from that number on into quarantine.
  void Quarantine(const RobotId& robot, std::int64_t from_number);
  void DropQuarantined(const RobotId& robot);
  bool HasQuarantined(const RobotId& robot) const;

  struct Corrected {
    bool covers_doubt = false;  // what is in doubt now came out of quarantine
    double moved_m = 0.0;       // by which a pose was moved at most; a radian counts as 3 m
  };
  // The anchors, in frame map, move the robot's way up to `time_ns`. What is in quarantine comes
  // out of it if the last anchor is not before it; entries from the number `doubtful_from` on,
  // which are in doubt now, apart from those of earlier doubts.
  // `start`, a place of the way, moves with it if it was not merged; its heading does not count.
  // Errors, with nothing changed: kFailedPrecondition if nothing is kept, HISTORY_TRIMMED if an
  // anchor is of a time that was merged; kInvalidArgument for times of which nothing was heard, and
  // for ways that would lead beyond the limit of poses. Cost: O(entries of the robot * log).
  absl::StatusOr<Corrected> Correct(const RobotId& robot, std::int64_t time_ns,
                                    const std::vector<PoseAnchor>& anchors,
                                    std::int64_t doubtful_from = 0, WayPoint* start = nullptr);

  // The errors of Correct, if these points were added to the robot's way before. Cost: as of it.
  absl::Status CheckCorrection(const RobotId& robot, std::int64_t time_ns,
                               const std::vector<PoseAnchor>& anchors,
                               const std::vector<WayPoint>& added) const;

  // Of all that is not in quarantine, in the order in which it came; what was merged is in
  // Readings and Sampled only. Cost: O(readings * log).
  struct Heard {
    ReadingSource source;
    std::int64_t number = 0;
    std::int64_t time_ns = 0;
    Point2 place;  // of the sensor
    GasReading reading;
    std::size_t species = 0;  // place among the mission's gases
    bool is_part = false;     // of a reading of which another part came before
  };
  std::vector<Heard> HeardReadings() const;
  // By gas, of what HeardReadings gave.
  std::vector<ReadingStore> Readings(const std::vector<Heard>& heard) const;
  // The same.
  std::vector<SampledCells> Sampled(const std::vector<Heard>& heard) const;
  // Scans from that number on. Cost: O(entries).
  std::vector<PlacedScan> ScansFrom(std::int64_t number) const;
  // What they are to be inserted into. Cost: O(cells).
  OccupancyGrid Base() const;
  // From now on no scan counts as another of one that is there already.
  void CloseKeyScans();

  // Merges what is oldest until it holds no more than so many bytes; if that does not do, it keeps
  // nothing from now on.
  void Trim(std::int64_t most_bytes);
  std::int64_t bytes() const { return bytes_ + base_bytes(); }
  // Whether anything was corrected or put into quarantine: only then does it tell more than the
  // map and the readings do.
  bool was_used() const { return used_; }

  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);

 private:
  static constexpr std::int64_t kReadingBytes = 136;  // with a short name of its sensor
  static constexpr std::int64_t kScanBytes = 104;     // beside the packed scan

  struct KeptReading {
    std::int64_t number = 0;
    std::int64_t time_ns = 0;
    Pose2 pose;
    GasReading reading;
    bool quarantined = false;
    std::uint8_t species = 0;
    Point2 robot_from_sensor;
    std::string sensor;
    double offset_stddev_ppm = 0.0;
    bool is_part = false;

    Point2 place() const { return PlaceOnRobot(pose, robot_from_sensor); }
    std::int64_t bytes() const {
      constexpr std::size_t kShort = 15;  // lies in the entry itself
      const std::size_t name = sensor.size() > kShort ? sensor.size() + 1 : 0;
      return kReadingBytes + static_cast<std::int64_t>(name);
    }

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  struct KeptScan {
    std::int64_t number = 0;
    std::int64_t time_ns = 0;
    Pose2 pose;
    int times = 1;
    WayPoint last;  // of the scans that it stands for: where the robot was before it jumped, if so
    bool quarantined = false;
    std::shared_ptr<const PackedScan> scan;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  struct Way {
    std::vector<KeptReading> readings;
    std::vector<KeptScan> scans;
    WayPoint latest;              // of all, also of scans that count as others
    std::int64_t merged_ns = -1;  // what was taken until then cannot be corrected
    bool key_scan_closed = true;  // the next one is a key scan

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };

  Way& WayOf(const RobotId& robot);
  std::vector<WayPoint> PointsOf(const Way& way, const std::vector<WayPoint>& added) const;
  absl::StatusOr<WayCorrection> CorrectionOf(const RobotId& robot, std::int64_t time_ns,
                                             const std::vector<PoseAnchor>& anchors,
                                             const std::vector<WayPoint>& added) const;
  absl::Status CheckAnchors(const RobotId& robot, const Way& way,
                            const std::vector<WayPoint>& points,
                            const std::vector<PoseAnchor>& anchors) const;
  template <typename Archive, typename Self>
  static void VisitSpecies(Archive& archive, Self& self);
  void Merge(std::int64_t below_number, std::int64_t most_bytes);
  void GiveUp();
  std::int64_t OldestNumber() const;
  std::int64_t base_map_bytes() const;
  std::int64_t base_bytes() const;                // with readings
  std::vector<ReadingStore> NoReadings() const {  // by species
    std::vector<ReadingStore> stores;
    for (const GasOptions& gas : gases_) stores.emplace_back(gas, occupancy_.resolution_m);
    return stores;
  }
  std::vector<SampledCells> NothingSampled() const {  // by species
    return std::vector<SampledCells>(gases_.size(), SampledCells(occupancy_.resolution_m));
  }
  static std::int64_t BytesOf(const Way& way);
  bool IsWhole() const;  // of what was read

  bool keeps_;
  OccupancyOptions occupancy_;
  std::vector<GasOptions> gases_;
  double pose_limit_m_;
  std::shared_ptr<const Grid<CellState>> prior_map_;

  std::int64_t next_number_ = 1;
  std::int64_t bytes_ = 0;  // of entries
  bool used_ = false;
  std::int64_t merged_ns_ = -1;  // of robots that are not known yet
  std::map<RobotId, Way> ways_;
  std::optional<OccupancyGrid> base_map_;    // none: the known map
  std::vector<ReadingStore> base_readings_;  // by species
  std::vector<SampledCells> base_sampled_;   // by species
};

}  // namespace plumescout
