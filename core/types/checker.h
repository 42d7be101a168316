// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <concepts>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"

namespace plumescout {

// Collects the first violation, so that a Validate reads as a table of fields. NaN is in no range.
// Where value and ends are all whole numbers, they are compared as such and told digit by digit.
class Checker {
 public:
  Checker& InRange(absl::string_view field, double value, double low, double high) {
    return Within(value >= low && value <= high, field, value, "[", low, high, "]");
  }
  Checker& InRange(absl::string_view field, std::integral auto value, std::integral auto low,
                   std::integral auto high) {
    const bool holds = std::cmp_greater_equal(value, low) && std::cmp_less_equal(value, high);
    return Within(holds, field, value, "[", low, high, "]");
  }
  // Without its lower end.
  Checker& InRangeAbove(absl::string_view field, double value, double low, double high) {
    return Within(value > low && value <= high, field, value, "(", low, high, "]");
  }
  // Without its upper end.
  Checker& InRangeBelow(absl::string_view field, double value, double low, double end) {
    return Within(value >= low && value < end, field, value, "[", low, end, ")");
  }
  Checker& InRangeBelow(absl::string_view field, std::integral auto value, std::integral auto low,
                        std::integral auto end) {
    const bool holds = std::cmp_greater_equal(value, low) && std::cmp_less(value, end);
    return Within(holds, field, value, "[", low, end, ")");
  }
  Checker& AtLeast(absl::string_view field, std::integral auto value, std::integral auto least) {
    if (std::cmp_less(value, least)) Fail(field, value, absl::StrCat("must be >= ", least));
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
  template <typename Value>
  Checker& Require(bool holds, absl::string_view field, Value value, absl::string_view rule) {
    if (!holds) Fail(field, value, rule);
    return *this;
  }
  // OK, or kInvalidArgument naming field, value and rule.
  const absl::Status& status() const { return status_; }

 private:
  template <typename Value, typename Low, typename High>
  Checker& Within(bool holds, absl::string_view field, Value value, absl::string_view opening,
                  Low low, High high, absl::string_view closing) {
    if (!holds) {
      Fail(field, value, absl::StrCat("must be in ", opening, low, ", ", high, closing));
    }
    return *this;
  }

  template <typename Value>
  void Fail(absl::string_view field, Value value, absl::string_view rule) {
    if (status_.ok()) {
      status_ = absl::InvalidArgumentError(absl::StrCat(field, " = ", value, " ", rule));
    }
  }

  absl::Status status_;
};

}  // namespace plumescout
