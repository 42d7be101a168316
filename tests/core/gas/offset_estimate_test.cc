// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/offset_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "tests/core/gas/field/field_case.h"

namespace plumescout {
namespace offset_estimate_test {

using ::plumescout::testing::DefaultField;
using ::plumescout::testing::DenseTruth;
using ::plumescout::testing::EngineOf;
using ::plumescout::testing::FieldCase;
using ::plumescout::testing::RandomFieldCase;

// Evidence of `columns` sensors in random cells, which the field hears too. Cells that are not
// active hold some as well.
std::vector<OffsetColumn> AddSensors(FieldCase& c, int sensors, Rng& rng) {
  std::vector<OffsetColumn> columns;
  for (int k = 0; k < sensors; ++k) {
    OffsetColumn column;
    column.prior_precision_per_ppm2 = rng.Uniform(0.2, 4.0);
    for (std::size_t cell = 0; cell < c.cells.size(); ++cell) {
      if (rng.Uniform01() > 0.2) continue;
      const double precision = rng.Uniform(0.5, 20.0);
      const Evidence evidence = {precision, precision * rng.Uniform(0.0, 30.0)};
      column.cells.push_back({cell, evidence});
      if (!c.cells[cell].active) continue;
      c.cells[cell].precision += evidence.precision;
      c.cells[cell].weighted_deviation += evidence.weighted_deviation;
    }
    columns.push_back(column);
  }
  return columns;
}

// Field and offsets as one dense system.
struct Joint {
  Joint(const FieldCase& c, const std::vector<OffsetColumn>& columns) : field(c.Dense()) {
    const Eigen::Index cells = field.mean_ppm().size();
    const auto offsets = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(cells + offsets, cells + offsets);
    Eigen::VectorXd information = Eigen::VectorXd::Zero(cells + offsets);
    precision.topLeftCorner(cells, cells) = field.covariance().inverse();
    information.head(cells) = precision.topLeftCorner(cells, cells) * field.mean_ppm();
    for (Eigen::Index k = 0; k < offsets; ++k) {
      const OffsetColumn& column = columns[static_cast<std::size_t>(k)];
      precision(cells + k, cells + k) = column.prior_precision_per_ppm2;
      for (const SensorEvidence& e : column.cells) {
        if (!c.cells[e.cell].active) continue;
        const Eigen::Index i = field.variable(e.cell);
        precision(cells + k, cells + k) += e.evidence.precision;
        precision(i, cells + k) += e.evidence.precision;
        precision(cells + k, i) += e.evidence.precision;
        information(cells + k) += e.evidence.weighted_deviation;
      }
    }
    covariance = precision.inverse();
    mean_ppm = covariance * information;
  }

  DenseTruth field;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd mean_ppm;
};

TEST(OffsetEstimateTest, IsTheJointPosteriorOfFieldAndOffsets) {
  for (const int sensors : {1, 2, 5, 9}) {
    SCOPED_TRACE(sensors);
    Rng rng(static_cast<std::uint64_t>(sensors));
    FieldCase c = RandomFieldCase(13, 11, 0.25, rng);
    const std::vector<OffsetColumn> columns = AddSensors(c, sensors, rng);
    const FieldEngine engine = EngineOf(c, DefaultField());
    const OffsetEstimate estimate = EstimateOffsets(engine, columns);
    const Joint joint(c, columns);
    const Eigen::Index cells = joint.field.mean_ppm().size();
    for (Eigen::Index k = 0; k < sensors; ++k) {
      const auto column = static_cast<std::size_t>(k);
      EXPECT_NEAR(estimate.offset_ppm[column], joint.mean_ppm(cells + k), 1e-8);
      EXPECT_NEAR(estimate.stddev_ppm[column], std::sqrt(joint.covariance(cells + k, cells + k)),
                  1e-8);
    }
    for (std::size_t cell = 0; cell < c.cells.size(); ++cell) {
      if (!c.cells[cell].active) {
        EXPECT_EQ(estimate.mean_ppm[cell], 0.0);
        EXPECT_EQ(estimate.variance_ppm2[cell], 0.0);
        continue;
      }
      const Eigen::Index i = joint.field.variable(cell);
      EXPECT_NEAR(engine.mean_ppm(cell) + estimate.mean_ppm[cell], joint.mean_ppm(i), 1e-8);
      EXPECT_NEAR(engine.variance_ppm2(cell) + estimate.variance_ppm2[cell], joint.covariance(i, i),
                  1e-9);
    }
  }
}

TEST(OffsetEstimateTest, ASensorThatReadNothingHasItsPriorAlone) {
  Rng rng(3);
  const FieldCase c = RandomFieldCase(6, 5, 0.1, rng);
  OffsetColumn column;
  column.prior_precision_per_ppm2 = 4.0;
  const OffsetEstimate estimate = EstimateOffsets(EngineOf(c), {&column, 1});
  EXPECT_DOUBLE_EQ(estimate.offset_ppm[0], 0.0);
  EXPECT_DOUBLE_EQ(estimate.stddev_ppm[0], 0.5);
  for (const double shift : estimate.mean_ppm) EXPECT_EQ(shift, 0.0);
}

}  // namespace offset_estimate_test
}  // namespace plumescout
