// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <vector>

#include "lib/neural/kernels.hpp"

namespace faultline {
namespace {

using Eigen::Index;

constexpr int kBlock = 64;   // samples: two panels of them fit into the first-level cache
constexpr int kColumns = 4;  // with kVectors, as many sums as fit into sixteen registers
constexpr int kVectors = 3;

/// sums[c][r] += rows[n][r] * columns[n][c] over the samples n, for a panel of rows and kColumns columns.
template <int Width>
[[gnu::always_inline]] inline void tile_body(const double* rows, const double* columns, int samples,
                                             double* const* sums) {
  using Vector [[gnu::vector_size(Width * sizeof(double))]] = double;
  constexpr int kSums = kColumns * kVectors;  // column c, vector v at c * kVectors + v
  for (int strip = 0; strip < kGramPanel; strip += kVectors * Width) {
    Vector sum[kSums];
#pragma GCC unroll 12
    for (int i = 0; i < kSums; ++i)
      std::memcpy(&sum[i], sums[i / kVectors] + strip + i % kVectors * Width, sizeof(Vector));
    for (int n = 0; n < samples; ++n) {
      const double *row = rows + n * kGramPanel + strip, *column = columns + n * kGramPanel;
#pragma GCC unroll 12
      for (int i = 0; i < kSums; ++i) {
        Vector values;
        std::memcpy(&values, row + i % kVectors * Width, sizeof(Vector));
        sum[i] += column[i / kVectors] * values;
      }
    }
#pragma GCC unroll 12
    for (int i = 0; i < kSums; ++i)
      std::memcpy(sums[i / kVectors] + strip + i % kVectors * Width, &sum[i], sizeof(Vector));
  }
}

using TileKernel = void (*)(const double*, const double*, int, double* const*);

void tile_base(const double* rows, const double* columns, int samples, double* const* sums) {
  tile_body<2>(rows, columns, samples, sums);
}

#if defined(__x86_64__) && defined(__GNUC__)
[[gnu::target("avx2")]] void tile_avx2(const double* rows, const double* columns, int samples,
                                       double* const* sums) {
  tile_body<4>(rows, columns, samples, sums);
}
[[gnu::target(FAULTLINE_AVX512)]] void tile_avx512(const double* rows, const double* columns, int samples,
                                                   double* const* sums) {
  tile_body<8>(rows, columns, samples, sums);
}

TileKernel tile_for(VectorUnit unit) {
  return unit == VectorUnit::avx512 ? tile_avx512 : unit == VectorUnit::avx2 ? tile_avx2 : tile_base;
}
#else
TileKernel tile_for(VectorUnit) { return tile_base; }
#endif

/// The rows of a panel for one sample, aligned to cache lines.
struct alignas(64) PanelRow {
  double values[kGramPanel];
};

/// Packs samples first .. first + count - 1 as [panel][sample].
void pack(const Eigen::MatrixXd& features, Index first, int count, std::vector<PanelRow>& packed) {
  PanelRow* to = packed.data();
  for (Index panel = 0; panel < features.rows(); panel += kGramPanel)
    for (Index n = first; n < first + count; ++n, ++to)
      std::copy_n(features.col(n).data() + panel, kGramPanel, to->values);
}

}  // namespace

void add_gram(const Eigen::MatrixXd& features, Eigen::MatrixXd& gram, VectorUnit unit) {
  const TileKernel tile = tile_for(unit);
  std::vector<PanelRow> packed(features.rows() / kGramPanel * kBlock);
  for (Index first = 0; first < features.cols(); first += kBlock) {
    const int count = static_cast<int>(std::min<Index>(kBlock, features.cols() - first));
    pack(features, first, count, packed);
    for (Index below = 0; below < features.rows(); below += kGramPanel)
      for (Index column = 0; column < below + kGramPanel; column += kColumns) {
        double* sums[kColumns];
        for (int c = 0; c < kColumns; ++c) sums[c] = gram.col(column + c).data() + below;
        const PanelRow *rows = &packed[below / kGramPanel * count],
                       *columns = &packed[column / kGramPanel * count];
        tile(rows->values, columns->values + column % kGramPanel, count, sums);
      }
  }
}

}  // namespace faultline
