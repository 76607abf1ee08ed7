// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/boundary_potential.hpp>
#include <cambium/poisson/face_waves.hpp>
#include <cambium/poisson/free_space_convolution.hpp>

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
        box_(detail::all_dirichlet<3>(), checked_cells(lattice), execution),
        waves_(checked_cells(lattice), box_, execution),
        potential_(checked_cells(lattice), lattice_green<3>(lattice.nodes(), execution), execution) {
    for (int d = 0; d < 3; ++d) {
      const Index<3> cells = checked_cells(lattice);
      for (auto* faces : {&charge_, &value_}) {
        for (auto& face : (*faces)[static_cast<std::size_t>(d)]) {
          face.width = static_cast<std::size_t>(cells[d == 0 ? 1 : 0]) + 1;
          face.values.resize(face.width * (static_cast<std::size_t>(cells[d == 2 ? 1 : 2]) + 1));
        }
      }
    }
  }

  const Lattice<3>& lattice() const { return lattice_; }

  /// \throws SizeError if a field is not on the lattice of the solver \throws ValueError if a value is not finite; u is
  ///         unchanged then
  void solve(const Field<T, 3>& f, Field<T, 3>& u) {
    if (!(f.lattice() == lattice_) || !(u.lattice() == lattice_)) {
      throw SizeError("a field is not on the lattice this Poisson solver was made for: make one solver per lattice");
    }
    load(f);
    waves_.clear();
    box_.use_waves([&](const Index<3>& m, T* waves) { waves_.leave_charges(m, waves); });
    waves_.add_partial_charges();
    charges_to_nodes(f);
    potential_(charge_, value_);
    values_to_waves();
    box_.put_waves([&](const Index<3>& m, T* waves) { waves_.add_values(m, waves); });
    box_.to_nodes([&](const Index<3>& m, const T* values) {
      std::copy_n(values, box_.sizes()[0], u.data() + lattice_.number(m + Index<3>::constant(1)));
    });
    store(u);
  }

 private:
  using Box3 = detail::BoxTransform<3, T, E>;

  static Index<3> checked_cells(const Lattice<3>& lattice) {
    for (int d = 0; d < 3; ++d) {
      if (lattice.periodic(d) || lattice.nodes()[d] < 3) {
        throw LatticeError(detail::message("lattice is periodic or has no node between its faces along axis ", d,
                                           ": free space needs bounded axes of two cells or more"));
      }
    }
    return lattice.nodes() - Index<3>::constant(1);
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
        waves_.face(d, side).clear_margins();
        waves_.face(d, side).transform();
        waves_.face(d, side).for_each_row([&](const Index<2>& m, const T* values) {
          T* const to = nodes.at(1, static_cast<std::size_t>(m[1]) + 1);
          for (std::ptrdiff_t i = 0; i < waves_.face(d, side).sizes()[0]; ++i) to[i] += values[i];
        });
      }
    }
  }
  void values_to_waves() {
    for (int d = 0; d < 3; ++d) {
      for (int side = 0; side < 2; ++side) {
        auto& nodes = value_[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)];
        const T scale = static_cast<T>(1.0 / box_.norm());
        waves_.face(d, side).clear_margins();
        waves_.face(d, side).for_each_row([&](const Index<2>& m, T* values) {
          const T* const from = nodes.at(1, static_cast<std::size_t>(m[1]) + 1);
          for (std::ptrdiff_t i = 0; i < waves_.face(d, side).sizes()[0]; ++i) values[i] = scale * from[i];
        });
        waves_.face(d, side).transform();
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
  detail::FaceWaves<T, E> waves_;
  detail::BoundaryPotential<T, E> potential_;
  detail::Faces<T> charge_;
  detail::Faces<T> value_;
};

}  // namespace cambium
