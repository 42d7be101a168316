// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/observation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"
#include "proto/convert/geometry.h"

namespace plumescout {
namespace {

// The helpers below overload these rather than hide them.
using plumescout::FromProto;
using plumescout::ToProto;

constexpr double kRangeUnit_m = 0.005;
constexpr int kNoReturn = 0;
constexpr int kInvalid = 65535;
constexpr int kMaxCount = kInvalid - 1;
constexpr double kMaxAngle_rad = 2.0 * M_PI;  // bearings and steps beyond a turn are mistakes
constexpr double kMaxRange_m = 1000.0;        // the most any mission may allow
constexpr double kMaxRangeUnit_m = 1.0;

double RangeUnit_m(const Scan& scan) {
  double longest_m = 0.0;
  for (const float range_m : scan.ranges_m) {
    if (std::isfinite(range_m)) longest_m = std::max(longest_m, static_cast<double>(range_m));
  }
  return std::max(kRangeUnit_m, longest_m / kMaxCount);
}

int EncodeRange(double range_m, double unit_m) {
  if (range_m == std::numeric_limits<double>::infinity()) return kNoReturn;
  if (!(range_m > 0.0)) return kInvalid;
  return std::clamp(static_cast<int>(std::lround(range_m / unit_m)), 1, kMaxCount);
}

float DecodeRange(int count, double unit_m) {
  if (count == kNoReturn) return std::numeric_limits<float>::infinity();
  if (count == kInvalid) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(count * unit_m);
}

v1::GasReading ToProto(const GasReading& reading) {
  v1::GasReading proto;
  proto.set_concentration_ppm(reading.concentration_ppm);
  proto.set_stddev_ppm(std::sqrt(reading.variance_ppm2));
  proto.set_sensor_index(reading.sensor);
  return proto;
}

v1::SequenceGap ToProto(const SequenceGap& gap) {
  v1::SequenceGap proto;
  proto.set_first_sequence(gap.first_sequence);
  proto.set_last_sequence(gap.last_sequence);
  return proto;
}

v1::PoseCorrection ToProto(const PoseCorrection& correction) {
  v1::PoseCorrection proto;
  for (const PoseAnchor& anchor : correction.anchors) {
    v1::PoseAnchor& added = *proto.add_anchors();
    added.set_sample_time_ns(anchor.sample_time_ns);
    *added.mutable_pose() = ToProto(anchor.pose);
  }
  return proto;
}

v1::RobotStatus ToProto(const RobotStatus& status) {
  v1::RobotStatus proto;
  proto.set_battery_share(status.battery_share);
  return proto;
}

absl::StatusOr<PoseCorrection> FromProto(const v1::PoseCorrection& proto, absl::string_view field) {
  PoseCorrection correction;
  correction.anchors.reserve(static_cast<std::size_t>(proto.anchors_size()));
  for (int i = 0; i < proto.anchors_size(); ++i) {
    const v1::PoseAnchor& anchor = proto.anchors(i);
    const std::string name = absl::StrCat(Join(field, "anchors"), "[", i, "]");
    PLUMESCOUT_RETURN_IF_ERROR(
        CheckIntRange(Join(name, "sample_time_ns"), anchor.sample_time_ns(), 0, kMaxTime_ns));
    PLUMESCOUT_RETURN_IF_ERROR(CheckPresent(Join(name, "pose"), anchor.has_pose()));
    PLUMESCOUT_ASSIGN_OR_RETURN(const Pose2 pose, FromProto(anchor.pose(), Join(name, "pose")));
    correction.anchors.push_back({anchor.sample_time_ns(), pose});
  }
  return correction;
}

absl::StatusOr<RobotStatus> FromProto(const v1::RobotStatus& proto, absl::string_view field) {
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckRange(Join(field, "battery_share"), proto.battery_share(), 0.0, 1.0));
  return RobotStatus{proto.battery_share()};
}

absl::StatusOr<GasReading> FromProto(const v1::GasReading& proto, absl::string_view field) {
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckNotNegative(Join(field, "concentration_ppm"), proto.concentration_ppm()));
  const std::string stddev = Join(field, "stddev_ppm");
  PLUMESCOUT_RETURN_IF_ERROR(CheckNotNegative(stddev, proto.stddev_ppm()));
  const double variance_ppm2 = proto.stddev_ppm() * proto.stddev_ppm();
  const bool squared_well =
      std::isfinite(variance_ppm2) && (variance_ppm2 > 0.0) == (proto.stddev_ppm() > 0.0);
  if (!squared_well) return FieldError(stddev, proto.stddev_ppm(), "has no square in a double");
  return GasReading{proto.concentration_ppm(), variance_ppm2, proto.sensor_index()};
}

absl::StatusOr<SequenceGap> FromProto(const v1::SequenceGap& proto, std::int64_t sequence,
                                      absl::string_view field) {
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange(Join(field, "first_sequence"), proto.first_sequence(), sequence, sequence));
  PLUMESCOUT_RETURN_IF_ERROR(CheckIntRange(Join(field, "last_sequence"), proto.last_sequence(),
                                           proto.first_sequence(), kMaxSequence));
  return SequenceGap{proto.first_sequence(), proto.last_sequence()};
}

absl::Status ReadPayload(const v1::Observation& proto, absl::string_view field,
                         Observation& observation) {
  switch (proto.payload_case()) {
    case v1::Observation::kScan: {
      PLUMESCOUT_ASSIGN_OR_RETURN(observation.payload,
                                  FromProto(proto.scan(), Join(field, "scan")));
      return absl::OkStatus();
    }
    case v1::Observation::kGas: {
      PLUMESCOUT_ASSIGN_OR_RETURN(observation.payload, FromProto(proto.gas(), Join(field, "gas")));
      return absl::OkStatus();
    }
    case v1::Observation::kGap: {
      PLUMESCOUT_ASSIGN_OR_RETURN(observation.payload,
                                  FromProto(proto.gap(), observation.sequence, Join(field, "gap")));
      return absl::OkStatus();
    }
    case v1::Observation::kCorrection: {
      PLUMESCOUT_ASSIGN_OR_RETURN(observation.payload,
                                  FromProto(proto.correction(), Join(field, "correction")));
      return absl::OkStatus();
    }
    case v1::Observation::kStatus: {
      PLUMESCOUT_ASSIGN_OR_RETURN(observation.payload,
                                  FromProto(proto.status(), Join(field, "status")));
      return absl::OkStatus();
    }
    case v1::Observation::PAYLOAD_NOT_SET:
      break;
  }
  return FieldError(Join(field, "payload"), "must be one of scan, gas, gap, correction, status");
}

}  // namespace

v1::LaserScan ToProto(const Scan& scan) {
  v1::LaserScan proto;
  const double unit_m = RangeUnit_m(scan);
  proto.set_start_angle_rad(scan.start_angle_rad);
  proto.set_angle_step_rad(scan.angle_step_rad);
  proto.set_max_range_m(scan.max_range_m);
  proto.set_range_unit_m(unit_m);
  std::string& bytes = *proto.mutable_ranges_u16();
  bytes.reserve(2 * scan.ranges_m.size());
  for (const float range_m : scan.ranges_m) {
    const int count = EncodeRange(range_m, unit_m);
    bytes.push_back(static_cast<char>(count & 0xff));
    bytes.push_back(static_cast<char>(count >> 8));
  }
  return proto;
}

v1::Observation ToProto(const Observation& observation) {
  v1::Observation proto;
  proto.set_sequence(observation.sequence);
  proto.set_sample_time_ns(observation.sample_time_ns);
  *proto.mutable_pose() = ToProto(observation.pose);
  if (const auto* scan = std::get_if<Scan>(&observation.payload)) {
    *proto.mutable_scan() = ToProto(*scan);
  } else if (const auto* gas = std::get_if<GasReading>(&observation.payload)) {
    *proto.mutable_gas() = ToProto(*gas);
  } else if (const auto* gap = std::get_if<SequenceGap>(&observation.payload)) {
    *proto.mutable_gap() = ToProto(*gap);
  } else if (const auto* correction = std::get_if<PoseCorrection>(&observation.payload)) {
    *proto.mutable_correction() = ToProto(*correction);
  } else if (const auto* status = std::get_if<RobotStatus>(&observation.payload)) {
    *proto.mutable_status() = ToProto(*status);
  }
  return proto;
}

absl::StatusOr<Scan> FromProto(const v1::LaserScan& proto, absl::string_view field) {
  const std::string& bytes = proto.ranges_u16();
  const std::string ranges = Join(field, "ranges_u16");
  PLUMESCOUT_RETURN_IF_ERROR(CheckRange(Join(field, "start_angle_rad"), proto.start_angle_rad(),
                                        -kMaxAngle_rad, kMaxAngle_rad));
  PLUMESCOUT_RETURN_IF_ERROR(CheckRange(Join(field, "angle_step_rad"), proto.angle_step_rad(),
                                        -kMaxAngle_rad, kMaxAngle_rad));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive(Join(field, "max_range_m"), proto.max_range_m()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckRange(Join(field, "max_range_m"), proto.max_range_m(), 0.0, kMaxRange_m));
  PLUMESCOUT_RETURN_IF_ERROR(CheckPositive(Join(field, "range_unit_m"), proto.range_unit_m()));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckRange(Join(field, "range_unit_m"), proto.range_unit_m(), 0.0, kMaxRangeUnit_m));
  if (bytes.size() % 2 != 0) return FieldError(ranges, "must hold two bytes a beam");
  const std::size_t beams = bytes.size() / 2;
  if (beams < 1 || beams > kMaxBeams) {
    return FieldError(ranges, static_cast<double>(beams), "beams; must be 1 to 100000");
  }
  Scan scan{proto.start_angle_rad(), proto.angle_step_rad(), proto.max_range_m(), {}};
  scan.ranges_m.reserve(beams);
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const int low = static_cast<unsigned char>(bytes[i]);
    const int high = static_cast<unsigned char>(bytes[i + 1]);
    scan.ranges_m.push_back(DecodeRange(low | high << 8, proto.range_unit_m()));
  }
  return scan;
}

absl::StatusOr<Observation> FromProto(const v1::Observation& proto, absl::string_view field) {
  Observation observation;
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange(Join(field, "sequence"), proto.sequence(), 1, kMaxSequence));
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckIntRange(Join(field, "sample_time_ns"), proto.sample_time_ns(), 0, kMaxTime_ns));
  observation.sequence = proto.sequence();
  observation.sample_time_ns = proto.sample_time_ns();
  const std::string pose = Join(field, "pose");
  PLUMESCOUT_RETURN_IF_ERROR(
      CheckPresent(pose, proto.has_pose() || proto.has_gap() || proto.has_status()));
  PLUMESCOUT_ASSIGN_OR_RETURN(observation.pose, FromProto(proto.pose(), pose));
  PLUMESCOUT_RETURN_IF_ERROR(ReadPayload(proto, field, observation));
  return observation;
}

absl::Status RefusalFromCore(const absl::Status& refusal, absl::string_view field) {
  constexpr FieldName kRenamed[] = {{"scan.ranges", "scan.ranges_u16"},
                                    {"gas.variance_ppm2", "gas.stddev_ppm"},
                                    {"gas.sensor", "gas.sensor_index"}};
  return WithField(refusal, field, kRenamed);
}

}  // namespace plumescout
