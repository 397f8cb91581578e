// SPDX-License-Identifier: GPL-3.0-or-later
// A weighted least-squares fit of a few terms, by Cholesky's method.
#pragma once

#include <array>
#include <cmath>

namespace medial {

template <int kTerms>
class NormalEquations {
 public:
  using Terms = std::array<double, kTerms>;

  void add(const Terms& row, double value, double weight) {
    for (int i = 0; i < kTerms; ++i) {
      const double weighted = weight * row[i];
      for (int j = 0; j <= i; ++j) matrix_[i][j] += weighted * row[j];
      right_[i] += weighted * value;
    }
  }
  // The sums of products of terms, for j <= i, and of a term with the values, where they are known.
  void set(int i, int j, double sum) { matrix_[i][j] = sum; }
  void set_right(int i, double sum) { right_[i] = sum; }
  // Adds to the square of a term, which holds its coefficient back.
  void hold_back(int term, double by) { matrix_[term][term] += by; }
  double square(int term) const { return matrix_[term][term]; }
  const Terms& right() const { return right_; }

  // Replaces the matrix by its factor; returns whether each term is independent of those before it,
  // by more than a share of its square.
  bool factorise(double share) {
    for (int i = 0; i < kTerms; ++i) {
      const double square = matrix_[i][i];
      for (int j = 0; j <= i; ++j) {
        double rest = matrix_[i][j];
        for (int k = 0; k < j; ++k) rest -= matrix_[i][k] * matrix_[j][k];
        if (j < i) {
          matrix_[i][j] = rest / matrix_[j][j];
        } else if (rest > share * square) {
          matrix_[i][i] = std::sqrt(rest);
        } else {
          return false;
        }
      }
    }
    return true;
  }
  // Both need the factor. The first returns what each term adds: the squares are those by which the
  // sum of squares falls. The second turns it into the coefficients of the first `terms` alone.
  Terms added(Terms x) const {
    for (int i = 0; i < kTerms; ++i) {
      for (int j = 0; j < i; ++j) x[i] -= matrix_[i][j] * x[j];
      x[i] /= matrix_[i][i];
    }
    return x;
  }
  Terms coefficients(Terms x, int terms = kTerms) const {
    for (int i = terms - 1; i >= 0; --i) {
      for (int j = i + 1; j < terms; ++j) x[i] -= matrix_[j][i] * x[j];
      x[i] /= matrix_[i][i];
    }
    return x;
  }

 private:
  std::array<Terms, kTerms> matrix_{};  // the lower half, then its factor
  Terms right_{};
};

}  // namespace medial
