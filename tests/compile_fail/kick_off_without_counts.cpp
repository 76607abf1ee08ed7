// expect: cambium: a kick-off.s Method is made from Params and called as method\(band, distance, execution\), which
// returns KickOffCounts SPDX-FileCopyrightText: The Cambium authors SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/reinit/fast_marching.hpp>

struct Start {
  struct Params {};
  template <class T, int D>
  struct Method {
    explicit Method(const Params&) {}
    template <cambium::Execution E>
#ifdef CAMBIUM_CONTROL
    cambium::KickOffCounts operator()(const cambium::NarrowBand<T, D>&, std::span<T>, const E&) {
      return {};
    }
#else
    int operator()(const cambium::NarrowBand<T, D>&, std::span<T>, const E&) {
      return 0;
    }
#endif
  };
};

int main() { cambium::FastMarching<Start>::Method<double, 2> method; }
