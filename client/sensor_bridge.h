// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "absl/status/status.h"
#include "client/lag_correction.h"
#include "client/robot_driver.h"
#include "core/types/gas_reading.h"
#include "core/types/observation.h"
#include "core/types/pose2.h"
#include "core/types/scan.h"

namespace plumescout::client {

// How often each sensor is read, by the robot's clock; 0 switches a sensor off.
struct SensorRates {
  double scan_hz = 10.0;
  double gas_hz = 2.0;
};

// How readings of a slow gas sensor become readings of the air.
struct GasSampling {
  double time_constant_s = 0.0;  // of the sensor's first-order lag, undone before sending; 0: not
  // Readings count only when the robot has stood for so long (stop-and-sample, [XIT] section VII);
  // their lag is undone from the beginning of the stop. 0: they always count.
  double settling_s = 0.0;
};

// When a periodic reading is due: at start + k / rate for whole k, so that rounding and lateness
// never add up. Readings missed while nobody asked are skipped, not made up for.
class SampleSchedule {
 public:
  SampleSchedule(std::int64_t start_ns, double rate_hz);

  // Whether a reading is due at `now_ns`; if so, the next one is put on its place of the grid.
  bool Due(std::int64_t now_ns);
  // The earliest time at which Due() is true; nothing if switched off.
  std::optional<std::int64_t> next_ns() const;

 private:
  std::int64_t TimeOf_ns(std::int64_t count) const;
  void PlaceAfter(std::int64_t now_ns);

  std::int64_t start_ns_;
  double rate_hz_;
  std::int64_t next_count_ = 0;
};

// Reads a robot's sensors when they are due and hands every reading, with the pose and the time at
// which it was taken, to a sink (normally the robot's log). The lag of the gas sensor is undone.
// Corrections of past poses come before what is sensed after them.
class SensorBridge {
 public:
  using Sink = std::function<void(std::int64_t sample_time_ns, const Pose2& pose,
                                  ObservationPayload payload)>;

  // Both sensors are due at once. `driver` must outlive the bridge.
  SensorBridge(RobotDriver& driver, const SensorRates& rates, const GasSampling& gas_sampling,
               Sink sink);

  // Reads what is due now; `standing`: the robot stands, and will until the next call. A sensor
  // that answers kUnavailable has nothing to say this time: it is counted and passed over. Any
  // other error of a sensor is returned.
  absl::Status Poll(bool standing = false);

  const std::optional<Scan>& latest_scan() const { return latest_scan_; }
  const Pose2& latest_scan_pose() const { return latest_scan_pose_; }
  std::int64_t scans_taken() const { return scans_taken_; }
  std::int64_t readings_missed() const { return readings_missed_; }

 private:
  void PollCorrection();
  absl::Status PollScan();
  absl::Status PollGas();
  void NoteStanding(bool standing, std::int64_t now_ns);
  void HandOnSettled(const GasSample& measured);
  absl::Status Missed(const absl::Status& status);

  RobotDriver& driver_;
  Sink sink_;
  SampleSchedule scan_schedule_;
  SampleSchedule gas_schedule_;
  double gas_rate_hz_;
  GasSampling gas_sampling_;
  LagCorrection lag_correction_;
  std::optional<std::int64_t> standing_since_ns_;
  std::optional<GasSample> first_of_stop_;
  std::optional<Scan> latest_scan_;
  Pose2 latest_scan_pose_;
  std::int64_t scans_taken_ = 0;
  std::int64_t readings_missed_ = 0;
};

}  // namespace plumescout::client
