// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/field_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumescout::lab {
namespace {

double LogAboveFloor(float ppm) { return std::log(std::max<double>(kFloor_ppm, ppm)); }

struct Sums {
  double n = 0.0;
  double a = 0.0;
  double b = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;

  void Add(double a_value, double b_value) {
    n += 1.0;
    a += a_value;
    b += b_value;
    aa += a_value * a_value;
    bb += b_value * b_value;
    ab += a_value * b_value;
  }
  double Correlation() const {
    const double a_spread = n * aa - a * a;
    const double b_spread = n * bb - b * b;
    if (!(a_spread > 0.0 && b_spread > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    return (n * ab - a * b) / std::sqrt(a_spread * b_spread);
  }
};

}  // namespace

FieldAgreement Compare(const Grid<float>& a_ppm, const Grid<float>& b_ppm,
                       const Grid<CellState>& occupancy, double critical_ppm) {
  Sums logs;
  Sums plain;
  double both = 0.0;
  double either = 0.0;
  for (std::size_t i = 0; i < occupancy.size(); ++i) {
    if (occupancy[i] != CellState::kFree) continue;
    logs.Add(LogAboveFloor(a_ppm[i]), LogAboveFloor(b_ppm[i]));
    plain.Add(a_ppm[i], b_ppm[i]);
    const bool in_a = a_ppm[i] > critical_ppm;
    const bool in_b = b_ppm[i] > critical_ppm;
    both += in_a && in_b ? 1.0 : 0.0;
    either += in_a || in_b ? 1.0 : 0.0;
  }
  return {logs.Correlation(), either > 0.0 ? both / either : 1.0, plain.b / plain.a};
}

}  // namespace plumescout::lab
