// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// Collects the first violation, so that a Validate reads as a table of fields. NaN is in no range.
class Checker {
 public:
  Checker& InRange(absl::string_view field, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      Fail(field, value, absl::StrCat("must be in [", low, ", ", high, "]"));
    }
    return *this;
  }
  // Without its lower end.
  Checker& InRangeAbove(absl::string_view field, double value, double low, double high) {
    if (!(value > low && value <= high)) {
      Fail(field, value, absl::StrCat("must be in (", low, ", ", high, "]"));
    }
    return *this;
  }
  Checker& Finite(absl::string_view field, double value) {
    return Require(std::isfinite(value), field, value, "must be finite");
  }
  Checker& Positive(absl::string_view field, double value) {
    return Require(value > 0.0 && std::isfinite(value), field, value, "must be > 0 and finite");
  }
  Checker& NotNegative(absl::string_view field, double value) {
    return Require(value >= 0.0 && std::isfinite(value), field, value, "must be >= 0 and finite");
  }
  Checker& Negative(absl::string_view field, double value) {
    return Require(value < 0.0 && std::isfinite(value), field, value, "must be < 0 and finite");
  }
  // A rule of the caller's own: "must be ...".
  Checker& Require(bool holds, absl::string_view field, double value, absl::string_view rule) {
    if (!holds) Fail(field, value, rule);
    return *this;
  }
  // OK, or kInvalidArgument naming field, value and rule.
  const absl::Status& status() const { return status_; }

 private:
  void Fail(absl::string_view field, double value, absl::string_view rule) {
    if (status_.ok()) {
      status_ = absl::InvalidArgumentError(absl::StrCat(field, " = ", value, " ", rule));
    }
  }

  absl::Status status_;
};

}  // namespace plumescout
