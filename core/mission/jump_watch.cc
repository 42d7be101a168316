// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/mission/jump_watch.h"

#include <algorithm>
#include <utility>

namespace plumescout {
namespace {

constexpr int kLeastBeams = 20;            // that can be judged
constexpr double kContradictShare = 0.15;  // of these
constexpr double kEitherWayShare = 0.03;   // of these, short of walls, and as many beyond

bool Contradicts(const ScanFit& fit) {
  const auto judged = static_cast<double>(fit.judged());
  return static_cast<double>(fit.short_of + fit.beyond) >= kContradictShare * judged &&
         static_cast<double>(std::min(fit.short_of, fit.beyond)) >= kEitherWayShare * judged;
}

}  // namespace

JumpVerdict JumpWatch::Note(const RobotId& robot, std::int64_t number, std::int64_t time_ns,
                            const ScanFit& fit) {
  const auto found = robots_.find(robot);
  if (fit.judged() < kLeastBeams) {
    return found != robots_.end() && found->second.suspect ? JumpVerdict::kSuspect
                                                           : JumpVerdict::kTrusted;
  }
  Watched& watched = robots_[robot];
  const bool contradicts = Contradicts(fit);
  if (watched.suspect) return NoteOfSuspect(watched, contradicts, number, time_ns);
  if (watched.contradicts.size() == kWindow) DropFirst(watched);
  watched.numbers.push_back(number);
  watched.contradicts.push_back(contradicts ? 1 : 0);
  const auto count = std::count(watched.contradicts.begin(), watched.contradicts.end(), 1);
  if (count < kContradicting) return JumpVerdict::kTrusted;
  while (watched.contradicts.front() == 0) DropFirst(watched);
  watched.suspect = true;
  watched.fits = false;
  return JumpVerdict::kTurnsSuspect;
}

void JumpWatch::DropFirst(Watched& watched) {
  watched.doubtful_from = watched.numbers.front() + 1;
  watched.numbers.erase(watched.numbers.begin());
  watched.contradicts.erase(watched.contradicts.begin());
}

void JumpWatch::Trust(const RobotId& robot, std::int64_t number) {
  Watched trusted;
  trusted.doubtful_from = number;
  robots_[robot] = std::move(trusted);
}

JumpVerdict JumpWatch::NoteOfSuspect(Watched& watched, bool contradicts, std::int64_t number,
                                     std::int64_t time_ns) {
  if (contradicts) {
    watched.fits = false;
    return JumpVerdict::kSuspect;
  }
  if (!watched.fits) watched.fits_since_ns = time_ns;
  watched.fits = true;
  if (time_ns - watched.fits_since_ns < kFitting_ns) return JumpVerdict::kSuspect;
  watched = {};
  watched.doubtful_from = number;
  return JumpVerdict::kFitsAgain;
}

std::int64_t JumpWatch::DoubtfulFrom(const RobotId& robot) const {
  const auto found = robots_.find(robot);
  return found == robots_.end() ? 0 : found->second.doubtful_from;
}

bool JumpWatch::IsSuspect(const RobotId& robot) const {
  const auto found = robots_.find(robot);
  return found != robots_.end() && found->second.suspect;
}

}  // namespace plumescout
