// expect: cambium: a tumour has one policy of each kind at most
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/models/tumour/policy.hpp>

struct Fed {
  using Kind = cambium::tumour_kind::Nutrient;
};
struct Starved {
#ifdef CAMBIUM_CONTROL
  using Kind = cambium::tumour_kind::Necrosis;
#else
  using Kind = cambium::tumour_kind::Nutrient;
#endif
};

int main() { cambium::detail::check_tumour_policies<Fed, Starved>(); }
