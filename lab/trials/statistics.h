// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace plumescout::lab {

// What a sample tells of the population it was drawn from.
struct Spread {
  std::size_t count = 0;
  double mean = 0.0;     // NaN without values
  double stddev = 0.0;   // of the population, from count - 1; 0 for one value
  double half_95 = 0.0;  // the mean +- this holds the true mean in 95 % of all samples (Student)
};

Spread SpreadOf(std::span<const double> values);

// How many times as great as its partner in `b` a value of `a` is: the geometric mean over the
// pairs, with the 95 % interval that Student's gives for its logarithm. NaN without pairs; one pair
// has no interval (low = high = mean). REQUIRES: as many of one as of the other, all > 0.
struct PairedRatio {
  double mean = 1.0;
  double low = 1.0;
  double high = 1.0;
};
PairedRatio PairedRatioOf(std::span<const double> a, std::span<const double> b);

// 95 % interval of a figure of several worlds for which there is no formula: the percentile
// bootstrap, 2,000 draws of as many worlds as there are, with replacement, from a fixed seed.
// `figure` is told which worlds; draws of which it is not finite do not count, and the interval is
// NaN if it never is. REQUIRES: count > 0.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};
Interval BootstrapInterval(std::size_t count,
                           const std::function<double(std::span<const std::size_t>)>& figure);

// Two-sided p of "a and b are equally good", pair by pair: the share of all 2^n ways to swap the
// two of a pair that bring the means at least as far apart as they are (Fisher's permutation
// test). Assumes nothing about how values are distributed. Up to 20 pairs exact; beyond, a million
// swaps drawn from a fixed seed. 1 without pairs. REQUIRES: as many of one as of the other.
double PairedPValue(std::span<const double> a, std::span<const double> b);

// How much less than its baseline a sample is, in percent of the baseline's mean (of its size,
// where it is negative), with the 95 % interval: percentiles of 10,000 draws of pairs with
// replacement, from a fixed seed. REQUIRES: as many of one as of the other, > 0; a mean of the
// baseline not 0.
struct Reduction {
  double percent = 0.0;
  double low_95 = 0.0;
  double high_95 = 0.0;
};
Reduction ReductionOf(std::span<const double> values, std::span<const double> baseline);

// Wilson's 95 % interval of a share, of which `hits` of `trials` were seen; within [0, 1].
// REQUIRES: 0 <= hits <= trials, trials > 0.
struct ShareInterval {
  double low = 0.0;
  double high = 1.0;
};
ShareInterval WilsonInterval(int hits, int trials);

}  // namespace plumescout::lab
