// expect: fields of scalars and of vectors; see docs/concepts/Extension.md
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/extension/extension.hpp>

struct OfScalars {
  struct Params {};
  template <class T, int D>
  struct Method {
    explicit Method(const Params&) {}
    template <class V, cambium::Execution E>
#ifndef CAMBIUM_CONTROL
    requires std::same_as<V, T>
#endif
    void operator()(const cambium::NarrowBand<T, D>&, const cambium::Field<V, D, cambium::Sparse>&,
                    cambium::Field<V, D, cambium::Sparse>&, const E&) {}
  };
};

int main() { cambium::check_extension<OfScalars>(); }
