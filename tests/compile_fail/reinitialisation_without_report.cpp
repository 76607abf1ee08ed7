// expect: cambium: a reinitialisation.s Method is made from Params and called as method\(band, execution\), which
// returns a ReinitReport SPDX-FileCopyrightText: The Cambium authors SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/reinitialisation.hpp>

struct Silent {
  struct Params {};
  template <class T, int D>
  struct Method {
    explicit Method(const Params&) {}
    template <cambium::Execution E>
#ifdef CAMBIUM_CONTROL
    cambium::ReinitReport operator()(cambium::NarrowBand<T, D>&, const E&) {
      return {};
    }
#else
    void operator()(cambium::NarrowBand<T, D>&, const E&) {
    }
#endif
  };
};

int main() { cambium::check_reinitialisation<Silent>(); }
