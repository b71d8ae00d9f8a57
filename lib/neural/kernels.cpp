// SPDX-License-Identifier: MIT
#include "lib/neural/kernels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace faultline {
namespace {

/// tanh(x) = -(e^y - 1) / (e^y + 1), y = -2|x| = k ln 2 + r, e^r by the Pade approximant [5/5]
/// (E + O) / (E - O) with E even and O odd in r. Arranged so that nothing cancels near zero.
inline double tanh_of(double x) {
  constexpr double kRounder = 0x1.8p52;  // added and subtracted: rounds to the nearest whole number
  constexpr double kLn2High = 0x1.62e42fefa3800p-1, kLn2Low = 0x1.ef35793c76730p-45;
  double a = std::fabs(x);
  a = a > 20.0 ? 20.0 : a;  // in this order NaN stays NaN
  const double y = -2.0 * a;
  const double shifted = y * 1.4426950408889634 + kRounder;
  const double k = shifted - kRounder;
  const double r = (y - k * kLn2High) - k * kLn2Low;
  const double scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) << 52) +
                                             std::bit_cast<std::uint64_t>(1.0));
  const double r2 = r * r;
  const double even = 1.0 + r2 * (1.0 / 9.0 + r2 * (1.0 / 1008.0));
  const double odd = r * (0.5 + r2 * (1.0 / 72.0 + r2 * (1.0 / 30240.0)));
  const double minus = even - odd;
  const double numerator = scale * (odd + odd) + (scale - 1.0) * minus;
  return std::copysign(numerator / (numerator + 2.0 * minus), x);
}

[[gnu::always_inline]] inline void tanh_body(double* values, int count) {
  for (int first = 0; first < count; first += kLanes)
    for (int lane = 0; lane < kLanes; ++lane) values[first + lane] = tanh_of(values[first + lane]);
}

/// `Width` doubles in one vector register, loaded from and stored to any address.
template <int Width>
struct Pack {
  using Type [[gnu::vector_size(Width * sizeof(double))]] = double;
  static constexpr int kCount = kLanes / Width;

  [[gnu::always_inline]] static void load(Type& value, const double* from) {
    std::memcpy(&value, from, sizeof(Type));
  }
  [[gnu::always_inline]] static void store(double* to, const Type& value) {
    std::memcpy(to, &value, sizeof(Type));
  }
};

/// Numbers of a layer, column-major: two tables of `rows` x `columns`, or a table and a vector of `rows`.
struct LayerNumbers {
  const double* first;
  const double* second;
  int rows, columns;
};

/// `Count` outputs of a layer from `first` on: each input is loaded once for all of them.
template <int Width, int Count>
[[gnu::always_inline]] inline void affine_outputs(const LayerNumbers& layer, int first, const double* in,
                                                  double* out) {
  using P = Pack<Width>;
  constexpr int kSums = Count * P::kCount;  // output o, vector p at o * P::kCount + p
  typename P::Type sum[kSums];
#pragma GCC unroll 12
  for (int k = 0; k < kSums; ++k) sum[k] = layer.second[first + k / P::kCount] + typename P::Type{};
  for (int i = 0; i < layer.columns; ++i) {
    const double* weight = layer.first + i * layer.rows + first;
#pragma GCC unroll 12
    for (int k = 0; k < kSums; ++k) {
      typename P::Type x;
      P::load(x, in + i * kLanes + k % P::kCount * Width);
      sum[k] += weight[k / P::kCount] * x;
    }
  }
#pragma GCC unroll 12
  for (int k = 0; k < kSums; ++k)
    P::store(out + (first + k / P::kCount) * kLanes + k % P::kCount * Width, sum[k]);
}

/// `layer`: weights and bias of outputs x inputs.
template <int Width>
[[gnu::always_inline]] inline void affine_body(LayerNumbers layer, const double* in, double* out) {
  constexpr int kTogether = Width / 2;  // as many as fit into the registers of this width
  int o = 0;
  for (; o + kTogether <= layer.rows; o += kTogether) affine_outputs<Width, kTogether>(layer, o, in, out);
  for (; o < layer.rows; ++o) affine_outputs<Width, 1>(layer, o, in, out);
}

/// `layer`: centres and inverse radii of inputs x units.
template <int Width>
[[gnu::always_inline]] inline void distance_body(LayerNumbers layer, const double* in, double* sums) {
  const auto [centres, inverse_radii, inputs, units] = layer;
  using P = Pack<Width>;
  for (int u = 0; u < units; ++u) {
    typename P::Type sum[P::kCount] = {};
    for (int i = 0; i < inputs; ++i) {
      const double centre = centres[u * inputs + i], inverse = inverse_radii[u * inputs + i];
#pragma GCC unroll 8
      for (int p = 0; p < P::kCount; ++p) {
        typename P::Type z;
        P::load(z, in + i * kLanes + p * Width);
        z = (z - centre) * inverse;
        sum[p] += z * z;
      }
    }
#pragma GCC unroll 8
    for (int p = 0; p < P::kCount; ++p) P::store(sums + u * kLanes + p * Width, sum[p]);
  }
}

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

using TanhKernel = void (*)(double*, int);
using MatrixKernel = void (*)(LayerNumbers, const double*, double*);
using TileKernel = void (*)(const double*, const double*, int, double* const*);
struct Kernels {
  TanhKernel tanh;
  MatrixKernel affine;
  MatrixKernel distance;
  TileKernel tile;
};

// The same functions compiled for three instruction sets. Wider vectors hold more lanes; the result of a lane
// is the same.
void tanh_base(double* v, int n) { tanh_body(v, n); }
void affine_base(LayerNumbers layer, const double* in, double* out) { affine_body<2>(layer, in, out); }
void distance_base(LayerNumbers layer, const double* in, double* out) { distance_body<2>(layer, in, out); }

void tile_base(const double* rows, const double* columns, int samples, double* const* sums) {
  tile_body<2>(rows, columns, samples, sums);
}

#if defined(__x86_64__) && defined(__GNUC__)
[[gnu::target("avx2")]] void tanh_avx2(double* v, int n) { tanh_body(v, n); }
[[gnu::target("avx2")]] void affine_avx2(LayerNumbers layer, const double* in, double* out) {
  affine_body<4>(layer, in, out);
}
[[gnu::target("avx2")]] void distance_avx2(LayerNumbers layer, const double* in, double* out) {
  distance_body<4>(layer, in, out);
}
[[gnu::target(FAULTLINE_AVX512)]] void tanh_avx512(double* v, int n) { tanh_body(v, n); }
[[gnu::target(FAULTLINE_AVX512)]] void affine_avx512(LayerNumbers layer, const double* in, double* out) {
  affine_body<8>(layer, in, out);
}
[[gnu::target(FAULTLINE_AVX512)]] void distance_avx512(LayerNumbers layer, const double* in, double* out) {
  distance_body<8>(layer, in, out);
}

[[gnu::target("avx2")]] void tile_avx2(const double* rows, const double* columns, int samples,
                                       double* const* sums) {
  tile_body<4>(rows, columns, samples, sums);
}
[[gnu::target(FAULTLINE_AVX512)]] void tile_avx512(const double* rows, const double* columns, int samples,
                                                   double* const* sums) {
  tile_body<8>(rows, columns, samples, sums);
}

Kernels kernels_for(VectorUnit unit) {
  if (unit == VectorUnit::avx512) return {tanh_avx512, affine_avx512, distance_avx512, tile_avx512};
  if (unit == VectorUnit::avx2) return {tanh_avx2, affine_avx2, distance_avx2, tile_avx2};
  return {tanh_base, affine_base, distance_base, tile_base};
}
#else
Kernels kernels_for(VectorUnit) { return {tanh_base, affine_base, distance_base, tile_base}; }
#endif

template <class Second>
LayerNumbers numbers_of(const Eigen::MatrixXd& first, const Second& second) {
  return {first.data(), second.data(), static_cast<int>(first.rows()), static_cast<int>(first.cols())};
}

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

VectorUnit best_vector_unit() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f")) return VectorUnit::avx512;
  if (__builtin_cpu_supports("avx2")) return VectorUnit::avx2;
#endif
  return VectorUnit::baseline;
}

void tanh_in_place(double* values, int count, VectorUnit unit) { kernels_for(unit).tanh(values, count); }

void affine_lanes(const Eigen::MatrixXd& weights, const Eigen::VectorXd& bias, const double* in, double* out,
                  VectorUnit unit) {
  kernels_for(unit).affine(numbers_of(weights, bias), in, out);
}

void squared_distances_lanes(const Eigen::MatrixXd& centres, const Eigen::MatrixXd& inverse_radii,
                             const double* in, double* sums) {
  kernels_for(best_vector_unit()).distance(numbers_of(centres, inverse_radii), in, sums);
}

void add_gram(const Eigen::MatrixXd& features, Eigen::MatrixXd& gram, VectorUnit unit) {
  const TileKernel tile = kernels_for(unit).tile;
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
