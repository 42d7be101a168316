// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/types/pose2.h"

namespace plumescout {

// How far a robot has driven, from the poses of its observations. Displacements count once they
// come to kStep_m from the last that counted, so that a robot that stands does not drive by the
// noise of its poses; what is driven in smaller circles is missed. A jump to another place counts
// as driven. On a straight way noise of standard deviation s adds a share of about (s / kStep_m)^2;
// curves of radius R lose about kStep_m^2 / (24 R^2).
class Odometer {
 public:
  void Pass(Point2 place) {
    const double step_m = mark_ ? Distance_m(*mark_, place) : 0.0;
    if (mark_ && step_m < kStep_m) return;
    travelled_m_ += step_m;
    mark_ = place;
  }

  // It holds itself to be elsewhere now, and has not driven there.
  void GoOnFrom(Point2 place) {
    if (mark_) mark_ = place;
  }

  // Nobody knows where it holds itself to be until it passes the next place; it has not driven
  // there.
  void Forget() { mark_.reset(); }

  double travelled_m() const { return travelled_m_; }

  // See core/types/byte_archive.h.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self) {
    archive(self.mark_, self.travelled_m_);
  }

 private:
  static constexpr double kStep_m = 0.1;  // ten times the noise of a good localisation

  std::optional<Point2> mark_;
  double travelled_m_ = 0.0;
};

}  // namespace plumescout
