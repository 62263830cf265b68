// Tiles of four by two columns, eight rows at a time.
#include "stats/gram.h"

#include <algorithm>
#include <cstring>

#include "core/wide.h"

namespace frictab::stats {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index doubles = 8, tall = 4, wide = 2;
constexpr Index part_rows = 512;

typedef double Doubles __attribute__((vector_size(doubles * sizeof(double))));

// Adds a' b over `rows` rows to `sum` for each of four columns a with each of two columns b.
FRICTAB_WIDE void add_products(const double* const* a, const double* const* b, Index rows,
                               double* sum) {
  Doubles total[tall][wide] = {};
  Index r = 0;
  for (; r + doubles <= rows; r += doubles) {
    Doubles x[tall], y[wide];
    for (Index i = 0; i < tall; ++i)
      std::memcpy(&x[i], a[i] + r, sizeof(Doubles));
    for (Index j = 0; j < wide; ++j)
      std::memcpy(&y[j], b[j] + r, sizeof(Doubles));
    for (Index i = 0; i < tall; ++i)
      for (Index j = 0; j < wide; ++j)
        total[i][j] += x[i] * y[j];
  }
  for (Index i = 0; i < tall; ++i)
    for (Index j = 0; j < wide; ++j) {
      double all = 0;
      for (Index l = 0; l < doubles; ++l)
        all += total[i][j][l];
      for (Index rest = r; rest < rows; ++rest)
        all += a[i][rest] * b[j][rest];
      sum[i * wide + j] = all;
    }
}

} // namespace

MatrixXd gram(const Eigen::Ref<const MatrixXd>& columns) {
  const Index count = columns.cols();
  MatrixXd all = MatrixXd::Zero(count, count);
  const double *a[tall], *b[wide];
  double sum[tall * wide];
  for (Index first = 0; first < columns.rows(); first += part_rows) {
    const Index rows = std::min(part_rows, columns.rows() - first);
    // Past the end, repeats the last column; those products are not used.
    const auto column = [&](Index c) { return columns.col(std::min(c, count - 1)).data() + first; };
    for (Index i = 0; i < count; i += tall)
      for (Index j = 0; j < std::min(i + tall, count); j += wide) {
        for (Index k = 0; k < tall; ++k)
          a[k] = column(i + k);
        for (Index k = 0; k < wide; ++k)
          b[k] = column(j + k);
        add_products(a, b, rows, sum);
        for (Index p = i; p < std::min(i + tall, count); ++p)
          for (Index q = j; q < std::min({j + wide, p + 1, count}); ++q)
            all(p, q) += sum[(p - i) * wide + (q - j)];
      }
  }
  all.triangularView<Eigen::StrictlyUpper>() = all.transpose();
  return all;
}

} // namespace frictab::stats
