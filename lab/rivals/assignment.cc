// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/rivals/assignment.h"

#include <algorithm>
#include <limits>

namespace plumescout::lab {
namespace {

constexpr std::size_t kFree = std::numeric_limits<std::size_t>::max();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Rows are added one by one, each by the cheapest chain of changes to the columns of those before
// it, in costs less prices, which never are below 0.
class Matching {
 public:
  explicit Matching(const std::vector<std::vector<double>>& costs)
      : costs_(costs),
        columns_(costs.empty() ? 0 : costs.front().size()),
        row_price_(costs.size(), 0.0),
        column_price_(columns_, 0.0),
        row_of_(columns_, kFree) {}

  void Add(std::size_t row) {
    std::vector<double> nearest(columns_, kInfinity);  // to each column, from the rows in the chain
    std::vector<std::size_t> before(columns_, kFree);  // the column that it was reached from
    std::vector<char> in_chain(columns_, 0);
    std::size_t last = kFree;  // column; free: the chain is but the row itself
    std::size_t from = row;
    do {
      std::size_t next = kFree;
      for (std::size_t column = 0; column < columns_; ++column) {
        if (in_chain[column] != 0) continue;
        const double left = costs_[from][column] - row_price_[from] - column_price_[column];
        if (left < nearest[column]) {
          nearest[column] = left;
          before[column] = last;
        }
        if (next == kFree || nearest[column] < nearest[next]) next = column;
      }
      Pay(nearest[next], row, in_chain, nearest);
      in_chain[next] = 1;
      last = next;
      from = row_of_[next];
    } while (from != kFree);
    for (; before[last] != kFree; last = before[last]) row_of_[last] = row_of_[before[last]];
    row_of_[last] = row;
  }

  std::vector<std::size_t> columns() const {
    std::vector<std::size_t> taken(costs_.size(), 0);
    for (std::size_t column = 0; column < columns_; ++column) {
      if (row_of_[column] != kFree) taken[row_of_[column]] = column;
    }
    return taken;
  }

 private:
  void Pay(double step, std::size_t row, const std::vector<char>& in_chain,
           std::vector<double>& nearest) {
    row_price_[row] += step;
    for (std::size_t column = 0; column < columns_; ++column) {
      if (in_chain[column] != 0) {
        row_price_[row_of_[column]] += step;
        column_price_[column] -= step;
      } else {
        nearest[column] -= step;
      }
    }
  }

  const std::vector<std::vector<double>>& costs_;
  std::size_t columns_;
  std::vector<double> row_price_;
  std::vector<double> column_price_;
  std::vector<std::size_t> row_of_;  // by column
};

}  // namespace

std::vector<std::size_t> LeastAssignment(const std::vector<std::vector<double>>& costs) {
  Matching matching(costs);
  for (std::size_t row = 0; row < costs.size(); ++row) matching.Add(row);
  return matching.columns();
}

}  // namespace plumescout::lab
