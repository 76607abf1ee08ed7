// expect: a smoother is a plain struct that is called as smoother\(level, backwards, execution\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/multigrid.hpp>

struct Nothing {
#ifdef CAMBIUM_CONTROL
  template <class Level, class Execution>
  void operator()(Level&, bool, const Execution&) const {}
#endif
};

int main() {
  cambium::check_smoother<Nothing>();
  return 0;
}
