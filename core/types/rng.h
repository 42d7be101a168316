// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumescout {

// Small seeded generator (splitmix64 into xoshiro256**). Unlike the standard distributions, its
// draws are the same on every platform and library.
class Rng {
 public:
  explicit Rng(std::uint64_t seed);

  std::uint64_t Next();
  double Uniform01();                        // [0, 1)
  double Uniform(double low, double high);   // [low, high)
  std::uint64_t Below(std::uint64_t bound);  // [0, bound), unbiased; REQUIRES bound > 0
  double Gaussian();                         // mean 0, standard deviation 1

 private:
  std::uint64_t state_[4];
  double spare_gaussian_ = 0.0;
  bool has_spare_gaussian_ = false;
};

}  // namespace plumescout
