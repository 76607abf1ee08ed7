// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/boundary_potential.hpp>
#include <cambium/poisson/free_space_convolution.hpp>
#include <cambium/poisson/second_order.hpp>

namespace cambium {

/// The second-order difference equations of -Lap u = f on the infinite lattice, exactly: u at the nodes of a box that
/// holds the source, faces included. Jump corrections of the right-hand side work in it unchanged.
///
///     cambium::FreeSpacePoisson<3> poisson(lattice);
///     poisson.solve(f, u);
///
/// It is what FreeSpaceConvolution<D, LatticeKernel> solves, which serves in the plane. In space most of the work is
/// that of a box with zero values (James 1977, J. Comput. Phys. 25): solved by sines, it leaves charges at its faces,
/// the values next to them; their potential on the faces follows from the lattice Green's function by sums over faces
/// alone; and the solution with these as Dirichlet values differs by a few products for each wave, before the way back.
/// Sources on the faces are charges there. Kernel and transforms are made with the
/// object; a solve allocates nothing. Arguments and results may be the same field.
template <int D, class T = double, Execution E = OpenMP>
class FreeSpacePoisson : public FreeSpaceConvolution<D, LatticeKernel, T, E> {
  using FreeSpaceConvolution<D, LatticeKernel, T, E>::FreeSpaceConvolution;
};

template <class T, Execution E>
class FreeSpacePoisson<3, T, E> {
 public:
  static constexpr int dimension = 3;

  /// \throws LatticeError unless the lattice is bounded and has a node between its faces along every axis
  explicit FreeSpacePoisson(const Lattice<3>& lattice, const E& execution = {})
      : lattice_(lattice),
        execution_(execution),
        box_(dirichlet<3>(), checked_cells(lattice), execution),
        potential_(checked_cells(lattice), lattice_green<3>(lattice.nodes(), execution), execution) {
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      const auto size = static_cast<std::size_t>(box_.sizes()[d]);
      for (std::size_t k = 0; k < size; ++k) {
        const double theta = box_.line(d).phase(k);
        symbol_[axis].push_back(static_cast<T>(SecondOrder::second(theta)));
        beside_[axis][0].push_back(static_cast<T>(std::sin(theta)));
        beside_[axis][1].push_back(static_cast<T>(k % 2 == 0 ? std::sin(theta) : -std::sin(theta)));
      }
      while (symbol_[axis].size() % lines != 0) {
        symbol_[axis].push_back(T(1));
        for (auto& table : beside_[axis]) table.push_back(T(0));
      }
      const Index<3> cells = checked_cells(lattice);
      const Index<2> sides{cells[d == 0 ? 1 : 0], cells[d == 2 ? 1 : 2]};
      for (std::size_t side = 0; side < 2; ++side) {
        face_.emplace_back(dirichlet<2>(), sides, execution);
        for (auto* faces : {&charge_, &value_}) {
          auto& face = (*faces)[axis][side];
          face.width = static_cast<std::size_t>(sides[0]) + 1;
          face.values.resize(face.width * (static_cast<std::size_t>(sides[1]) + 1));
        }
      }
    }
    const std::size_t blocks = symbol_[0].size() / lines;
    partial_.resize(blocks * 2 * static_cast<std::size_t>(box_.sizes()[1] * box_.sizes()[2]));
  }

  const Lattice<3>& lattice() const { return lattice_; }

  /// \throws SizeError if a field is not on the lattice of the solver \throws ValueError if a value is not finite; u is
  ///         unchanged then
  void solve(const Field<T, 3>& f, Field<T, 3>& u) {
    if (!(f.lattice() == lattice_) || !(u.lattice() == lattice_)) {
      throw SizeError("a field is not on the lattice this Poisson solver was made for: make one solver per lattice");
    }
    load(f);
    for (int d = 1; d < 3; ++d) {
      for (int side = 0; side < 2; ++side) face(d, side).clear();
    }
    box_.use_waves([&](const Index<3>& m, T* waves) { leave_charges(m, waves); });
    add_partial_charges();
    charges_to_nodes(f);
    potential_(charge_, value_);
    values_to_waves();
    box_.put_waves([&](const Index<3>& m, T* waves) { add_values(m, waves); });
    box_.to_nodes([&](const Index<3>& m, const T* values) {
      std::copy_n(values, box_.sizes()[0], u.data() + lattice_.number(m + Index<3>::constant(1)));
    });
    store(u);
  }

 private:
  using Box3 = detail::BoxTransform<3, T, E>;
  using Box2 = detail::BoxTransform<2, T, E>;
  using Lanes = typename Box3::Line::Lanes;
  static constexpr std::size_t lines = Box3::lines;
  static constexpr std::size_t width = Box3::Line::width;

  template <int N>
  static std::array<Boundary, N> dirichlet() {
    std::array<Boundary, N> result;
    result.fill(Boundary::dirichlet);
    return result;
  }
  static Index<3> checked_cells(const Lattice<3>& lattice) {
    for (int d = 0; d < 3; ++d) {
      if (lattice.periodic(d) || lattice.nodes()[d] < 3) {
        throw LatticeError(detail::message("lattice is periodic or has no node between its faces along axis ", d,
                                           ": free space needs bounded axes of two cells or more"));
      }
    }
    return lattice.nodes() - Index<3>::constant(1);
  }
  Box2& face(int d, int side) { return face_[static_cast<std::size_t>(2 * d + side)]; }
  const T* beside(int d, int side, std::ptrdiff_t k) const {
    return beside_[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)].data() + k;
  }
  /// Transforms h^2 f over the norm of the transforms, at the nodes off the faces, along all axes but the last.
  void load(const Field<T, 3>& f) {
    const T scale = static_cast<T>(lattice_.spacing() * lattice_.spacing() / box_.norm());
    std::atomic<bool> finite = true;
    const auto good = [](T x) { return std::abs(x) <= std::numeric_limits<T>::max(); };
    box_.to_waves([&](const Index<3>& m, T* values) {
      const T* const from = f.data() + lattice_.number(m + Index<3>::constant(1));
      bool all = true;
      for (std::ptrdiff_t i = 0; i < box_.sizes()[0]; ++i) {
        all &= good(from[i]);
        values[i] = scale * from[i];
      }
      if (!all) finite = false;
    });
    for (int d = 0; d < 3; ++d) {
      for (int side = 0; side < 2; ++side) {
        for_each_face_node(d, side, [&](const Index<3>& node, std::size_t, std::size_t) {
          if (!good(f(node))) finite = false;
        });
      }
    }
    if (!finite) detail::require_finite(f, execution_);
  }

  /// Divides by the symbol and sums up what the waves make next to the faces, as waves along these.
  void leave_charges(const Index<3>& m, T* waves) {
    const auto j = static_cast<std::size_t>(m[1]);
    const auto block = static_cast<std::size_t>(m[0]) / lines;
    const auto planes = static_cast<std::size_t>(box_.sizes()[2]);
    T* const partial = partial_.data() + 2 * planes * (block * static_cast<std::size_t>(box_.sizes()[1]) + j);
    const std::array<Lanes, 2> along{Lanes(*beside(1, 0, m[1])), Lanes(*beside(1, 1, m[1]))};
    Lanes sums[2][2], symbol[2], weight[2][2];
    for (std::size_t half = 0; half < 2; ++half) {
      const auto i = m[0] + static_cast<std::ptrdiff_t>(half * width);
      symbol[half] = Lanes::load_aligned(symbol_[0].data() + i) + Lanes(symbol_[1][j]);
      for (int side = 0; side < 2; ++side) {
        weight[side][half] = Lanes::load_aligned(beside(0, side, i));
        sums[side][half] = Lanes(T(0));
      }
    }
    for (std::size_t k = 0; k < planes; ++k) {
      T* const row = waves + k * box_.pitch(2);
      Lanes x[2];
      for (std::size_t half = 0; half < 2; ++half) {
        x[half] = Lanes::load_aligned(row + half * width) / (symbol[half] + Lanes(symbol_[2][k]));
        x[half].store_aligned(row + half * width);
      }
      for (int side = 0; side < 2; ++side) {
        partial[2 * k + static_cast<std::size_t>(side)] = sum(fma(weight[side][0], x[0], weight[side][1] * x[1]));
        T* const across_1 = face(1, side).at({m[0], static_cast<std::ptrdiff_t>(k)});
        const Lanes factor(*beside(2, side, static_cast<std::ptrdiff_t>(k)));
        for (std::size_t half = 0; half < 2; ++half) {
          sums[side][half] = fma(factor, x[half], sums[side][half]);
          fma(along[static_cast<std::size_t>(side)], x[half], Lanes::load_aligned(across_1 + half * width))
              .store_aligned(across_1 + half * width);
        }
      }
    }
    for (int side = 0; side < 2; ++side) {
      T* const across_2 = face(2, side).at({m[0], m[1]});
      for (std::size_t half = 0; half < 2; ++half) sums[side][half].store_aligned(across_2 + half * width);
    }
  }
  /// The charges across axis 0 are sums over tiles, in their order.
  void add_partial_charges() {
    const auto rows = static_cast<std::size_t>(box_.sizes()[1]), planes = static_cast<std::size_t>(box_.sizes()[2]);
    const std::size_t blocks = symbol_[0].size() / lines;
    for_each_piece(execution_, planes, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t k = begin; k < end; ++k) {
          for (int side = 0; side < 2; ++side) {
            T sum = T(0);
            for (std::size_t block = 0; block < blocks; ++block) {
              sum += partial_[2 * (planes * (block * rows + j) + k) + static_cast<std::size_t>(side)];
            }
            *face(0, side).at({static_cast<std::ptrdiff_t>(j), static_cast<std::ptrdiff_t>(k)}) = sum;
          }
        }
      }
    });
  }

  /// Charges: h^2 times the source on a face, plus the value next to it.
  void charges_to_nodes(const Field<T, 3>& f) {
    const T scale = static_cast<T>(lattice_.spacing() * lattice_.spacing());
    for (int d = 0; d < 3; ++d) {
      for (int side = 0; side < 2; ++side) {
        auto& nodes = charge_[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)];
        for_each_face_node(d, side, [&](const Index<3>& node, std::size_t p, std::size_t q) {
          bool counted = false;  // on a face across an axis before this one
          for (int other = 0; other < d; ++other) {
            counted = counted || node[other] == 0 || node[other] == lattice_.nodes()[other] - 1;
          }
          *nodes.at(p, q) = counted ? T(0) : scale * f(node);
        });
        face(d, side).clear_margins();
        face(d, side).transform();
        face(d, side).for_each_row([&](const Index<2>& m, const T* values) {
          T* const to = nodes.at(1, static_cast<std::size_t>(m[1]) + 1);
          for (std::ptrdiff_t i = 0; i < face(d, side).sizes()[0]; ++i) to[i] += values[i];
        });
      }
    }
  }
  void values_to_waves() {
    for (int d = 0; d < 3; ++d) {
      for (int side = 0; side < 2; ++side) {
        auto& nodes = value_[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)];
        const T scale = static_cast<T>(1.0 / box_.norm());
        face(d, side).clear_margins();
        face(d, side).for_each_row([&](const Index<2>& m, T* values) {
          const T* const from = nodes.at(1, static_cast<std::size_t>(m[1]) + 1);
          for (std::ptrdiff_t i = 0; i < face(d, side).sizes()[0]; ++i) values[i] = scale * from[i];
        });
        face(d, side).transform();
      }
    }
  }

  /// Adds the solution whose values on the faces are given and whose differences vanish.
  void add_values(const Index<3>& m, T* waves) {
    const auto j = static_cast<std::size_t>(m[1]);
    Lanes symbol[2], across_0[2][2], across_2[2][2];
    for (std::size_t half = 0; half < 2; ++half) {
      const auto i = m[0] + static_cast<std::ptrdiff_t>(half * width);
      symbol[half] = Lanes::load_aligned(symbol_[0].data() + i) + Lanes(symbol_[1][j]);
      for (int side = 0; side < 2; ++side) {
        across_0[side][half] = Lanes::load_aligned(beside(0, side, i));
        across_2[side][half] = Lanes::load_aligned(face(2, side).at({i, m[1]}));
      }
    }
    const std::array<Lanes, 2> along{Lanes(*beside(1, 0, m[1])), Lanes(*beside(1, 1, m[1]))};
    for (std::ptrdiff_t k = 0; k < box_.sizes()[2]; ++k) {
      T* const row = waves + static_cast<std::size_t>(k) * box_.pitch(2);
      for (std::size_t half = 0; half < 2; ++half) {
        Lanes sum(T(0));
        for (int side = 0; side < 2; ++side) {
          const T* const across_1 = face(1, side).at({m[0], k}) + half * width;
          sum = fma(across_0[side][half], Lanes(*face(0, side).at({m[1], k})), sum);
          sum = fma(along[static_cast<std::size_t>(side)], Lanes::load_aligned(across_1), sum);
          sum = fma(Lanes(*beside(2, side, k)), across_2[side][half], sum);
        }
        const Lanes x = Lanes::load_aligned(row + half * width);
        const Lanes denominator = symbol[half] + Lanes(symbol_[2][static_cast<std::size_t>(k)]);
        (x + sum / denominator).store_aligned(row + half * width);
      }
    }
  }

  /// Calls f(node, p, q) for the nodes of a face, p and q being the node's places along the axes of the face.
  template <class F>
  void for_each_face_node(int d, int side, F&& f) const {
    const int p = d == 0 ? 1 : 0, q = d == 2 ? 1 : 2;
    Index<3> node;
    node[d] = side == 0 ? 0 : lattice_.nodes()[d] - 1;
    for (node[q] = 0; node[q] < lattice_.nodes()[q]; ++node[q]) {
      for (node[p] = 0; node[p] < lattice_.nodes()[p]; ++node[p]) {
        f(node, static_cast<std::size_t>(node[p]), static_cast<std::size_t>(node[q]));
      }
    }
  }

  void store(Field<T, 3>& u) {
    for (int d = 0; d < 3; ++d) {
      for (int side = 0; side < 2; ++side) {
        auto& values = value_[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)];
        for_each_face_node(d, side,
                           [&](const Index<3>& node, std::size_t p, std::size_t q) { u(node) = *values.at(p, q); });
      }
    }
  }

  Lattice<3> lattice_;
  E execution_;
  Box3 box_;
  std::vector<Box2> face_;
  detail::BoundaryPotential<T, E> potential_;
  detail::Faces<T> charge_;
  detail::Faces<T> value_;
  std::array<AlignedVector<T>, 3> symbol_;
  std::array<std::array<AlignedVector<T>, 2>, 3> beside_;
  AlignedVector<T> partial_;
};

}  // namespace cambium
