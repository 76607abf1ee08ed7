// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/models/tumour/jump_pressure.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>
#include <cambium/poisson/periodic.hpp>
#include <cambium/poisson/second_order.hpp>

namespace cambium {

namespace detail {

/// A constant outside that takes what is gained inside, so that f has no mean.
struct EvenSink {
  template <int D, class E>
  static double fill(const NarrowBand<double, D>& band, Field<double, D>& f, const E& execution) {
    for_each_side(band, execution, [&](std::size_t i, bool inside) {
      if (!inside) f[i] = 0.0;
    });
    return spread(band, f, execution);
  }
  /// Takes away, outside alone, the mean that corrections for jumps left.
  template <int D, class E>
  static void balance(const NarrowBand<double, D>& band, Field<double, D>& f, const E& execution) {
    spread(band, f, execution);
  }

 private:
  template <int D, class E>
  static double spread(const NarrowBand<double, D>& band, Field<double, D>& f, const E& execution) {
    const auto add = [](double a, double b) { return a + b; };
    const double sum = reduce(
        execution, f.size(), 0.0, [&](std::size_t i) { return f[i]; }, add);
    std::size_t outside = 0;
    for_each_side(band, Serial{}, [&](std::size_t, bool inside) { outside += inside ? 0 : 1; });
    const double share = -sum / static_cast<double>(outside);
    for_each_side(band, execution, [&](std::size_t i, bool inside) {
      if (!inside) f[i] += share;
    });
    return share;
  }
};

}  // namespace detail

/// A periodic box that is full: what the tumour gains, the rest of the box loses, everywhere alike:
///   -Lap p = -(integral of f over the tumour) / (volume of the box without the tumour) outside.
/// The tumour's volume grows by its sources, as it does in free space. (Taking the mean of f away everywhere, as
/// leaving out the mean mode of a Fourier transform does, takes the share of the box that the tumour fills of its
/// growth, too.) Shapes depend on the box. Takes a periodic lattice.
struct Periodic {
  using Kind = tumour_kind::Outside;
  /// Speed that a drop of the pressure with short waves causes, over their wave number.
  static constexpr double mobility = 0.5;

  template <int D, class K>
  class Method : public detail::JumpPressure<D, PeriodicPoisson<D, SecondOrder, double, OpenMP>, K, JumpExtension,
                                             detail::EvenSink> {
    using Params = typename PeriodicPoisson<D, SecondOrder, double, OpenMP>::Params;

   public:
    Method(const Lattice<D>& lattice, double reach, const OpenMP& execution)
        : Method::JumpPressure(lattice, reach, execution, Params{.mean = MeanPart::subtract}) {}
  };
};

}  // namespace cambium
