// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/way_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/types/error_reason.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

constexpr double kKeyDistance_m = 0.1;
constexpr double kKeyTurn_rad = 5.0 * M_PI / 180.0;
constexpr std::int64_t kKeyTime_ns = 1'000'000'000;
constexpr int kMostTimes = 9;  // by then log-odds have come to their clamp
// Doubt begins with the last scan that fitted, a little before a jump and its first anchor.
constexpr std::int64_t kDoubtBefore_ns = 10'000'000'000;
// So far away is what a scan sees.
constexpr double kSeen_m = 3.0;

bool IsAnother(const WayPoint& key, std::int64_t time_ns, const Pose2& pose) {
  return time_ns >= key.time_ns && time_ns - key.time_ns < kKeyTime_ns &&
         Distance_m(key.pose.position(), pose.position()) < kKeyDistance_m &&
         std::abs(WrapAngle_rad(pose.yaw_rad - key.pose.yaw_rad)) < kKeyTurn_rad;
}

double Move_m(const Pose2& from, const Pose2& to) {
  return Distance_m(from.position(), to.position()) +
         kSeen_m * std::abs(WrapAngle_rad(to.yaw_rad - from.yaw_rad));
}

bool IsWithin(const Pose2& pose, double limit_m) {
  return std::abs(pose.x_m) <= limit_m && std::abs(pose.y_m) <= limit_m;
}

}  // namespace

WayHistory::WayHistory(const MissionOptions& options)
    : keeps_(options.keep_scans),
      occupancy_(options.occupancy),
      gases_(GasOptionsOfAll(options)),
      pose_limit_m_(options.pose_limit_m),
      prior_map_(options.prior_map),
      base_readings_(NoReadings()),
      base_sampled_(NothingSampled()) {}

void WayHistory::BeginWith(const OccupancyGrid& map, const ReadingStore& readings,
                           const SampledCells& sampled, std::int64_t time_ns) {
  if (!keeps_) return;
  base_map_ = map;
  base_readings_.front() = readings.Unplaced();
  base_sampled_.front() = sampled;
  merged_ns_ = time_ns;
}

WayHistory::Way& WayHistory::WayOf(const RobotId& robot) {
  const auto [found, is_new] = ways_.try_emplace(robot);
  if (is_new) found->second.merged_ns = merged_ns_;
  return found->second;
}

void WayHistory::AddReading(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                            const GasReading& reading, bool quarantined, const GasSensor& sensor,
                            std::size_t species, bool is_part) {
  if (!keeps_) return;
  Way& way = WayOf(robot);
  way.readings.push_back({next_number_++, time_ns, pose, reading, quarantined,
                          static_cast<std::uint8_t>(species), sensor.robot_from_sensor, sensor.id,
                          sensor.offset_stddev_ppm, is_part});
  way.latest = {time_ns, pose};
  bytes_ += way.readings.back().bytes();
}

void WayHistory::AddScan(const RobotId& robot, std::int64_t time_ns, const Pose2& pose,
                         const Scan& scan, const std::vector<MaskDisc>& masks, bool quarantined) {
  if (!keeps_) return;
  Way& way = WayOf(robot);
  const std::int64_t number = next_number_++;
  way.latest = {time_ns, pose};
  if (!way.scans.empty() && !way.key_scan_closed) {
    KeptScan& last = way.scans.back();
    if (last.quarantined == quarantined && IsAnother({last.time_ns, last.pose}, time_ns, pose)) {
      last.times = std::min(last.times + 1, kMostTimes);
      last.last = way.latest;
      return;
    }
  }
  auto packed = std::make_shared<const PackedScan>(Pack(scan, masks));
  bytes_ += kScanBytes + packed->bytes();
  way.scans.push_back({number, time_ns, pose, 1, way.latest, quarantined, std::move(packed)});
  way.key_scan_closed = false;
}

void WayHistory::Quarantine(const RobotId& robot, std::int64_t from_number) {
  const auto found = ways_.find(robot);
  if (found == ways_.end()) return;
  const auto put = [&](auto& entries) {
    for (auto& entry : entries) entry.quarantined |= entry.number >= from_number;
  };
  put(found->second.readings);
  put(found->second.scans);
  used_ = true;
}

void WayHistory::DropQuarantined(const RobotId& robot) {
  const auto found = ways_.find(robot);
  if (found == ways_.end()) return;
  Way& way = found->second;
  std::erase_if(way.readings, [this](const KeptReading& entry) {
    if (entry.quarantined) bytes_ -= entry.bytes();
    return entry.quarantined;
  });
  std::erase_if(way.scans, [this](const KeptScan& entry) {
    if (entry.quarantined) bytes_ -= kScanBytes + entry.scan->bytes();
    return entry.quarantined;
  });
  way.key_scan_closed = true;
}

bool WayHistory::HasQuarantined(const RobotId& robot) const {
  const auto found = ways_.find(robot);
  if (found == ways_.end()) return false;
  const auto is_in = [](const auto& entry) { return entry.quarantined; };
  return std::any_of(found->second.readings.begin(), found->second.readings.end(), is_in) ||
         std::any_of(found->second.scans.begin(), found->second.scans.end(), is_in);
}

std::vector<WayPoint> WayHistory::PointsOf(const Way& way,
                                           const std::vector<WayPoint>& added) const {
  std::vector<WayPoint> points = added;
  points.reserve(added.size() + way.readings.size() + 2 * way.scans.size() + 1);
  for (const KeptReading& entry : way.readings) points.push_back({entry.time_ns, entry.pose});
  for (const KeptScan& entry : way.scans) {
    points.push_back({entry.time_ns, entry.pose});
    points.push_back(entry.last);
  }
  points.push_back(way.latest);
  std::stable_sort(points.begin(), points.end(),
                   [](const WayPoint& a, const WayPoint& b) { return a.time_ns < b.time_ns; });
  return points;
}

absl::Status WayHistory::CheckAnchors(const RobotId& robot, const Way& way,
                                      const std::vector<WayPoint>& points,
                                      const std::vector<PoseAnchor>& anchors) const {
  const std::int64_t first_ns = anchors.front().sample_time_ns;
  if (first_ns <= way.merged_ns) {
    return TypedError(absl::StatusCode::kFailedPrecondition, reason::kHistoryTrimmed,
                      absl::StrCat("correction.anchors[0].sample_time_ns = ", first_ns,
                                   " is before what is kept of robot \"", robot, "\", from after ",
                                   way.merged_ns));
  }
  if (first_ns < points.front().time_ns) {
    return absl::InvalidArgumentError(
        absl::StrCat("correction.anchors[0].sample_time_ns = ", first_ns,
                     " is before the robot's first observation, ", points.front().time_ns));
  }
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    if (IsWithin(anchors[i].pose, pose_limit_m_)) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        "correction.anchors[", i, "].pose = (", anchors[i].pose.x_m, ", ", anchors[i].pose.y_m,
        ") in frame map must be within pose_limit_m = ", pose_limit_m_));
  }
  return absl::OkStatus();
}

absl::StatusOr<WayCorrection> WayHistory::CorrectionOf(const RobotId& robot, std::int64_t time_ns,
                                                       const std::vector<PoseAnchor>& anchors,
                                                       const std::vector<WayPoint>& added) const {
  if (!keeps_) {
    return absl::FailedPreconditionError(
        "keep_scans = false, or memory is too short: the mission keeps nothing that could be "
        "corrected");
  }
  const auto found = ways_.find(robot);
  if (found == ways_.end()) {
    return absl::InvalidArgumentError(
        absl::StrCat("correction.anchors[0].sample_time_ns = ", anchors.front().sample_time_ns,
                     " is of a time of which no scan or reading is kept"));
  }
  const Way& way = found->second;
  const std::vector<WayPoint> points = PointsOf(way, added);
  PLUMESCOUT_RETURN_IF_ERROR(CheckAnchors(robot, way, points, anchors));
  WayCorrection correction(points, anchors);
  const auto stays_within = [&](const auto& entry) {
    return entry.time_ns > time_ns ||
           IsWithin(correction.Corrected(entry.time_ns, entry.pose), pose_limit_m_);
  };
  if (!std::all_of(way.readings.begin(), way.readings.end(), stays_within) ||
      !std::all_of(way.scans.begin(), way.scans.end(), stays_within) ||
      !std::all_of(added.begin(), added.end(), stays_within)) {
    return absl::InvalidArgumentError(absl::StrCat(
        "correction.anchors move the robot's way beyond pose_limit_m = ", pose_limit_m_));
  }
  return correction;
}

absl::Status WayHistory::CheckCorrection(const RobotId& robot, std::int64_t time_ns,
                                         const std::vector<PoseAnchor>& anchors,
                                         const std::vector<WayPoint>& added) const {
  return CorrectionOf(robot, time_ns, anchors, added).status();
}

absl::StatusOr<WayHistory::Corrected> WayHistory::Correct(const RobotId& robot,
                                                          std::int64_t time_ns,
                                                          const std::vector<PoseAnchor>& anchors,
                                                          std::int64_t doubtful_from,
                                                          WayPoint* start) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const WayCorrection correction,
                              CorrectionOf(robot, time_ns, anchors, {}));
  Way& way = ways_.at(robot);
  // When what is in quarantine begins, of the present doubt and of earlier ones.
  std::int64_t present_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t earlier_ns = present_ns;
  Corrected made;
  const auto correct = [&](auto& entry) {
    if (entry.time_ns > time_ns) return;
    const Pose2 corrected = correction.Corrected(entry.time_ns, entry.pose);
    made.moved_m = std::max(made.moved_m, Move_m(entry.pose, corrected));
    entry.pose = corrected;
  };
  const auto correct_all = [&](auto& entries) {
    for (auto& entry : entries) {
      std::int64_t& begin_ns = entry.number < doubtful_from ? earlier_ns : present_ns;
      if (entry.quarantined) begin_ns = std::min(begin_ns, entry.time_ns);
      correct(entry);
    }
  };
  correct_all(way.readings);
  correct_all(way.scans);
  for (KeptScan& entry : way.scans) correct(entry.last);
  correct(way.latest);
  made.covers_doubt = anchors.back().sample_time_ns >= present_ns;
  const bool covers_earlier = anchors.back().sample_time_ns >= earlier_ns;
  const std::int64_t from_ns = anchors.front().sample_time_ns - kDoubtBefore_ns;
  const auto release = [&](auto& entries) {
    for (auto& entry : entries) {
      const bool covered = entry.number < doubtful_from ? covers_earlier : made.covers_doubt;
      if (covered && entry.time_ns >= from_ns) entry.quarantined = false;
    }
  };
  release(way.readings);
  release(way.scans);
  way.key_scan_closed = true;
  if (start != nullptr && start->time_ns > way.merged_ns) correct(*start);
  used_ = true;
  return made;
}

std::vector<WayHistory::Heard> WayHistory::HeardReadings() const {
  std::vector<Heard> heard;
  for (const auto& [robot, way] : ways_) {
    for (const KeptReading& entry : way.readings) {
      if (entry.quarantined) continue;
      heard.push_back({{robot, entry.sensor, entry.offset_stddev_ppm},
                       entry.number,
                       entry.time_ns,
                       entry.place(),
                       entry.reading,
                       entry.species,
                       entry.is_part});
    }
  }
  std::sort(heard.begin(), heard.end(),
            [](const Heard& a, const Heard& b) { return a.number < b.number; });
  return heard;
}

std::vector<ReadingStore> WayHistory::Readings(const std::vector<Heard>& heard) const {
  std::vector<ReadingStore> stores = base_readings_;
  for (const Heard& one : heard) {
    stores[one.species].Add(one.time_ns, one.place, one.reading, one.is_part);
  }
  return stores;
}

std::vector<SampledCells> WayHistory::Sampled(const std::vector<Heard>& heard) const {
  std::vector<SampledCells> sampled = base_sampled_;
  for (const Heard& one : heard) sampled[one.species].Add(one.time_ns, one.place);
  return sampled;
}

std::vector<PlacedScan> WayHistory::ScansFrom(std::int64_t number) const {
  std::vector<std::pair<std::int64_t, PlacedScan>> entries;
  for (const auto& [robot, way] : ways_) {
    for (const KeptScan& entry : way.scans) {
      if (entry.quarantined || entry.number < number) continue;
      entries.push_back({entry.number, {entry.pose, entry.times, entry.scan}});
    }
  }
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PlacedScan> scans;
  scans.reserve(entries.size());
  for (auto& [at, scan] : entries) scans.push_back(std::move(scan));
  return scans;
}

OccupancyGrid WayHistory::Base() const {
  if (base_map_) return *base_map_;
  OccupancyGrid grid(occupancy_);
  if (prior_map_ != nullptr) grid.Learn(*prior_map_).IgnoreError();  // it was learnt before
  return grid;
}

void WayHistory::CloseKeyScans() {
  for (auto& [robot, way] : ways_) way.key_scan_closed = true;
}

bool WayHistory::IsWhole() const {
  const auto is_entry = [this](const auto& entry) {
    return entry.number >= 1 && entry.number < next_number_ && entry.time_ns >= 0 &&
           IsWithin(entry.pose, pose_limit_m_) && std::isfinite(entry.pose.yaw_rad);
  };
  const auto is_reading = [&](const KeptReading& entry) {
    return is_entry(entry) && entry.species < gases_.size();
  };
  const auto is_scan = [&](const KeptScan& entry) {
    return is_entry(entry) && entry.times >= 1 && entry.times <= kMostTimes &&
           entry.scan != nullptr;
  };
  return std::all_of(ways_.begin(), ways_.end(), [&](const auto& named) {
    const Way& way = named.second;
    return std::all_of(way.readings.begin(), way.readings.end(), is_reading) &&
           std::all_of(way.scans.begin(), way.scans.end(), is_scan);
  });
}

}  // namespace plumescout
