// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/belief/belief.h"
#include "core/types/ids.h"
#include "core/types/pose2.h"
#include "core/types/rectangle.h"
#include "core/types/trajectory.h"

namespace plumescout {

// Where a way comes too near to another robot, for the first time.
struct Meeting {
  RobotId robot;
  double time_s = 0.0;  // from now
  Point2 place;         // of the robot whose way it is
};

// How far apart the centres of two robots have to be beside the clearance that they keep: by both
// radii, and by what 2.5 standard deviations of how their frames lie to each other are more than
// the clearance.
double Reach_m(const RobotState& a, const RobotState& b, double clearance_m);
// With the clearance.
inline double Apart_m(const RobotState& a, const RobotState& b, double clearance_m) {
  return Reach_m(a, b, clearance_m) + clearance_m;
}

// What committed plans keep between robots, beside Reach_m. They were searched for on a belief of a
// moment ago, with more, and time to spare for who is early or late: what that found clear is so
// still, unless somebody was given another way since.
inline constexpr double kCommittedClearance_m = 0.1;

// Farther than this from its trajectory a robot is not following it: several times what followers
// stray, and less than the width of a corridor.
inline constexpr double kOffTrajectory_m = 0.5;

// The plan of a robot that asks on its way begins up to so far ahead of its latest pose: answers
// and poses take their time.
inline constexpr double kStartsAhead_m = 2.0;

// Where the other robots of a mission will be: on their live plans, from where they are along them,
// or where they stand. Prioritised planning in the order of commitment: a live plan is never
// changed for another robot, and who comes later waits, goes elsewhere or stays.
//
// A robot is early or late by a little, and by more the farther ahead: it is reckoned with at every
// place of its way from 0.5 s + 5 % before to 1 s + 10 % after its time there, and from earlier by
// as long as it was not heard of: it may have driven on since. Who has strayed from its way, or
// should have ended it long ago, stands where it is. So does who is silent, for kSilentBody_s after
// it was last heard of: then beams have met its body, if it is there. Beyond kHorizon_s nothing is
// foreseen. Steps are made for robots of up to 2 m/s.
class Traffic {
 public:
  static constexpr double kHorizon_s = 30.0;
  static constexpr double kMaxWait_s = 8.0;
  static constexpr double kSilentBody_s = 120.0;

  enum class Others { kEarlyOrLate, kOnTime };

  // For `robot`, one of `robots`, that keeps Reach_m and `clearance_m` between centres. Two that
  // are nearer already meet only if they come nearer still. Cost: O(robots * waypoints).
  Traffic(const std::map<RobotId, RobotRecord>& robots, const RobotId& robot, double clearance_m,
          std::int64_t now_ns, Others others = Others::kEarlyOrLate);

  // Keeps a way free that another of the robots is to go on, beside the place where it stands: as
  // if it were a live plan of its that begins now, and no way may end on it. REQUIRES: waypoints
  // not empty. Cost: O(waypoints + kHorizon_s), and O(waypoints) more for each FirstMeeting.
  void KeepWay(const RobotState& other, const Trajectory& way);
  bool keeps_ways() const { return !kept_ways_.empty(); }

  // Of a way that is begun now. Cost: O(others * kHorizon_s), less where they are far.
  std::optional<Meeting> FirstMeeting(const Trajectory& trajectory) const;
  // Of what is left of a way that is driven, from a time along it on.
  std::optional<Meeting> FirstMeeting(const Trajectory& trajectory, double from_s) const;
  // The shortest time to stand at the start of the way, up to `most_s`, at most kHorizon_s, so that
  // nobody is met there, on the way, and at its end. None: there is no such time. Cost: that of a
  // FirstMeeting for every half second.
  std::optional<double> LeastWait_s(const Trajectory& trajectory, double most_s = kMaxWait_s) const;

  // Where another robot will be: how far to keep from there, and until when, in seconds from now;
  // it may be infinity.
  struct Hold {
    Point2 place;
    double apart_m = 0.0;
    double until_s = 0.0;
  };
  // On the ways of all others for kHorizon_s, a fraction of a second apart.
  std::vector<Hold> Holds() const;

 private:
  // Another robot's centre at the times k * kStep_s from now.
  struct Other {
    RobotId robot;
    double reach_m = 0.0;  // Reach_m
    std::vector<Point2> places;
    double unheard_s = 0.0;  // it may be as much farther on
    double fastest_m = 0.0;  // in one step
    Rectangle around = {};   // all places
  };
  struct KeptWay {
    RobotId robot;
    double reach_m = 0.0;
    Trajectory way;
  };
  // A way in the same steps.
  struct Steps {
    std::vector<Point2> places;
    double fastest_m = 0.0;
    Rectangle around = {};
    bool ends = false;  // with the last of them; else it goes on beyond the horizon

    Point2 At(std::size_t step, std::size_t waited) const;
  };

  static void GoOn(const Trajectory& way, double from_s, Other& other);
  static Steps StepsOf(const Trajectory& trajectory, double from_s = 0.0);
  std::optional<Meeting> FindMeeting(const Steps& steps, std::size_t waited) const;
  std::optional<Meeting> FindEnd(const Steps& steps, std::size_t waited) const;
  std::optional<std::size_t> MeetingStep(const Other& other, const Steps& steps,
                                         std::size_t waited) const;

  RobotState self_;
  double clearance_m_;
  bool on_time_;
  std::vector<Other> others_;
  std::vector<KeptWay> kept_ways_;
};

// Has the robot stand for so long before it leaves. REQUIRES: waypoints not empty, wait_s >= 0.
void WaitAtStart(double wait_s, Trajectory& trajectory);

// Whether a robot follows its live plan: it is near that, or, with a new one, may be about to come
// to where that begins, and should not have ended it long ago. REQUIRES: a pose.
bool IsOnItsWay(const RobotRecord& record, std::int64_t now_ns);

// How far along its live plan a robot is, in seconds of the trajectory: by its latest pose, for it
// may be late; while it is to stand at a waypoint and is near, by the time: its latest pose may be
// from before it came there. REQUIRES: a live trajectory with waypoints, a pose.
double Progress_s(const RobotRecord& record, std::int64_t now_ns);
// By how much it has fallen behind the plan's times. REQUIRES: as Progress_s.
double Lateness_s(const RobotRecord& record, std::int64_t now_ns);

}  // namespace plumescout
