// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

namespace cambium {

/// Kinds of policies of a tumour. A policy names its kind in a nested type `Kind`, so that they are given in any order.
namespace tumour_kind {
struct Nutrient {};
struct Outside {};
struct Necrosis {};
struct Filter {};
struct Stepping {};
struct Motion {};
struct Reinit {};
}  // namespace tumour_kind

namespace detail {

/// The first of the policies that is of a kind, or the default.
template <class Kind, class Default, class... Policies>
struct PolicyOf {
  using Type = Default;
};
template <class Kind, class Default, class First, class... Rest>
struct PolicyOf<Kind, Default, First, Rest...> {
  using Type = std::conditional_t<std::is_same_v<typename First::Kind, Kind>, First,
                                  typename PolicyOf<Kind, Default, Rest...>::Type>;
};

/// How many of the policies are of a kind.
template <class Kind, class... Policies>
inline constexpr int policies_of = (0 + ... + (std::is_same_v<typename Policies::Kind, Kind> ? 1 : 0));

/// Checks at compile time that each policy is one of a tumour's, and no kind is named twice.
template <class... Policies>
constexpr void check_tumour_policies() {
  using namespace tumour_kind;
  static_assert(
      (true && ... && requires { typename Policies::Kind; }),
      "cambium: a policy of a tumour names its kind in a nested type Kind; see docs/concepts/TumourPolicy.md");
  if constexpr ((true && ... && requires { typename Policies::Kind; })) {
    constexpr bool once = policies_of<Nutrient, Policies...> <= 1 && policies_of<Outside, Policies...> <= 1 &&
                          policies_of<Necrosis, Policies...> <= 1 && policies_of<Filter, Policies...> <= 1 &&
                          policies_of<Stepping, Policies...> <= 1 && policies_of<Motion, Policies...> <= 1 &&
                          policies_of<Reinit, Policies...> <= 1;
    static_assert(once, "cambium: a tumour has one policy of each kind at most; see docs/concepts/TumourPolicy.md");
  }
}

}  // namespace detail
}  // namespace cambium
