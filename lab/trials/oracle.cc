// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/oracle.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/linalg/symmetric_matrix.h"
#include "core/types/status_macros.h"
#include "lab/linalg/sparse_cholesky.h"

namespace plumescout::lab {
namespace {

constexpr std::size_t kMaxCritical = 8000;
constexpr int kNoVariable = -1;

// The prior's precision matrix over the free cells, and which of them are critical.
struct PriorField {
  std::vector<Triplet> precision;
  int variables = 0;
  std::vector<int> critical;      // variables
  std::vector<double> truth_ppm;  // at these
};

PriorField MakePriorField(const Scene& scene, const GasOptions& gas) {
  const GridGeometry& geometry = scene.geometry();
  Grid<int> variable(geometry, kNoVariable);
  PriorField field;
  for (std::size_t i = 0; i < variable.size(); ++i) {
    if (scene.occupancy[i] != CellState::kFree) continue;
    variable[i] = field.variables++;
    const double truth_ppm = scene.conc_mean_ppm[i];
    if (truth_ppm <= scene.critical_threshold_ppm) continue;
    field.critical.push_back(variable[i]);
    field.truth_ppm.push_back(truth_ppm);
  }
  for (std::size_t i = 0; i < variable.size(); ++i) {
    const int a = variable[i];
    if (a == kNoVariable) continue;
    field.precision.push_back({a, a, gas.background_precision_per_ppm2});
    const Cell cell = geometry.CellAtIndex(i);
    for (const Cell next : {Cell{cell.x + 1, cell.y}, Cell{cell.x, cell.y + 1}}) {
      const int b = variable.At(next, kNoVariable);
      if (b == kNoVariable) continue;
      const double link = gas.prior_precision_per_ppm2;
      field.precision.insert(field.precision.end(), {{a, a, link}, {b, b, link}, {b, a, -link}});
    }
  }
  return field;
}

void Thin(PriorField& field) {
  const std::size_t stride = (field.critical.size() + kMaxCritical - 1) / kMaxCritical;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < field.critical.size(); i += std::max<std::size_t>(1, stride)) {
    field.critical[kept] = field.critical[i];
    field.truth_ppm[kept++] = field.truth_ppm[i];
  }
  field.critical.resize(kept);
  field.truth_ppm.resize(kept);
}

// Posterior over the critical cells: means and the whole covariance.
class CriticalPosterior {
 public:
  static absl::StatusOr<CriticalPosterior> Create(const PriorField& field, const GasOptions& gas) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const SymmetricMatrix matrix,
                                SymmetricFromTriplets(field.variables, field.precision));
    SparseCholesky cholesky;
    PLUMESCOUT_RETURN_IF_ERROR(cholesky.Factorize(matrix));
    const auto n = static_cast<Eigen::Index>(field.critical.size());
    CriticalPosterior posterior;
    posterior.noise_ppm2_ = 1.0F / static_cast<float>(gas.observation_precision_per_ppm2);
    posterior.covariance_.resize(n, n);
    posterior.residual_.resize(n);
    std::vector<double> column(static_cast<std::size_t>(field.variables));
    for (Eigen::Index c = 0; c < n; ++c) {
      const auto at = static_cast<std::size_t>(c);
      std::fill(column.begin(), column.end(), 0.0);
      column[static_cast<std::size_t>(field.critical[at])] = 1.0;
      PLUMESCOUT_RETURN_IF_ERROR(cholesky.Solve(column, column));
      for (Eigen::Index r = 0; r < n; ++r) {
        const int variable = field.critical[static_cast<std::size_t>(r)];
        posterior.covariance_(r, c) =
            static_cast<float>(column[static_cast<std::size_t>(variable)]);
      }
      posterior.residual_(c) = static_cast<float>(field.truth_ppm[at] - gas.background_mean_ppm);
    }
    posterior.PrepareErrors();
    return posterior;
  }

  Eigen::Index size() const { return residual_.size(); }

  // By how much a reading at c lowers the entropy, nats.
  double EntropyGain(Eigen::Index c) const {
    const float total = covariance_(c, c) + noise_ppm2_;
    const auto share =
        covariance_.col(c).array().square() / (covariance_.diagonal().array() * total);
    return -0.5 * static_cast<double>((1.0F - share).log().sum());
  }

  // Where a reading lowers the sum of squared errors most.
  Eigen::Index LeastErrorCell() const {
    const Eigen::ArrayXf gain = residual_.array() / (covariance_.diagonal().array() + noise_ppm2_);
    const Eigen::ArrayXf drop = 2.0F * gain * pull_.array() - gain.square() * squares_.array();
    Eigen::Index best = 0;
    drop.maxCoeff(&best);
    return best;
  }

  // Takes a reading of the truth at c.
  void Read(Eigen::Index c) {
    const float total = covariance_(c, c) + noise_ppm2_;
    const Eigen::VectorXf column = covariance_.col(c);
    const Eigen::VectorXf spread = covariance_.selfadjointView<Eigen::Lower>() * column;
    const float gain = residual_(c) / total;
    const Eigen::VectorXf scaled = column / total;
    // pull = C e and squares = diag(C C) follow from C' = C - column column^T / total.
    const float along = column.dot(residual_) - gain * column.squaredNorm();
    pull_ = pull_ - gain * spread - scaled * along;
    squares_.array() +=
        -2.0F * scaled.array() * spread.array() + scaled.array().square() * column.squaredNorm();
    residual_ -= gain * column;
    covariance_.noalias() -= column * scaled.transpose();
  }

  double SquaredError_ppm2() const { return static_cast<double>(residual_.squaredNorm()); }
  double Entropy_nats() const {
    return 0.5 * (2.0 * M_PI * M_E * covariance_.diagonal().cast<double>().array()).log().sum();
  }

 private:
  void PrepareErrors() {
    pull_ = covariance_ * residual_;
    squares_ = covariance_.colwise().squaredNorm().transpose();
  }

  Eigen::MatrixXf covariance_;  // ppm^2
  Eigen::VectorXf residual_;    // truth - mean, ppm
  Eigen::VectorXf pull_;        // covariance_ * residual_
  Eigen::VectorXf squares_;     // sums of squares of the columns
  float noise_ppm2_ = 0.0F;
};

// Gains only shrink as readings are added (the entropy is submodular), so a gain of an earlier
// round bounds today's: only the cells at the top are priced again (Minoux 1978).
void PlaceForEntropy(CriticalPosterior& posterior, int readings) {
  std::priority_queue<std::pair<double, Eigen::Index>> bounds;
  for (Eigen::Index c = 0; c < posterior.size(); ++c) {
    bounds.emplace(posterior.EntropyGain(c), c);
  }
  for (int k = 0; k < readings; ++k) {
    while (true) {
      const Eigen::Index c = bounds.top().second;
      bounds.pop();
      const double gain = posterior.EntropyGain(c);
      bounds.emplace(gain, c);
      if (bounds.top().second == c) break;
    }
    posterior.Read(bounds.top().second);
  }
}

}  // namespace

absl::StatusOr<MapMetrics> PlaceReadings(const Scene& scene, const GasOptions& gas, int readings,
                                         OracleAim aim) {
  PriorField field = MakePriorField(scene, gas);
  if (field.critical.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(scene.name, ": no gas above ", scene.critical_threshold_ppm, " ppm"));
  }
  const auto critical_cells = static_cast<int>(field.critical.size());
  Thin(field);
  PLUMESCOUT_ASSIGN_OR_RETURN(CriticalPosterior posterior, CriticalPosterior::Create(field, gas));
  double squares_zero = 0.0;
  for (const double truth_ppm : field.truth_ppm) squares_zero += truth_ppm * truth_ppm;
  if (aim == OracleAim::kEntropy) {
    PlaceForEntropy(posterior, readings);
  } else {
    for (int k = 0; k < readings; ++k) posterior.Read(posterior.LeastErrorCell());
  }
  const auto n = static_cast<double>(field.critical.size());
  MapMetrics metrics;
  metrics.completeness = 1.0;
  metrics.rmse_ppm = std::sqrt(posterior.SquaredError_ppm2() / n);
  metrics.rmse_zero_ppm = std::sqrt(squares_zero / n);
  metrics.entropy_nats = posterior.Entropy_nats() * critical_cells / n;
  metrics.critical_cells = critical_cells;
  return metrics;
}

}  // namespace plumescout::lab
