// expect: cambium: a reinitialisation has a nested template Method<T, D>
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/reinitialisation.hpp>

struct Idle {
  struct Params {};
#ifdef CAMBIUM_CONTROL
  template <class T, int D>
#endif
  struct Method {
    explicit Method(const Params&) {}
    template <class Band, class E>
    cambium::ReinitReport operator()(Band&, const E&) {
      return {};
    }
  };
};

int main() { cambium::check_reinitialisation<Idle>(); }
