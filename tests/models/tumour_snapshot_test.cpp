// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE tumour_snapshot
#include <bit>
#include <boost/test/unit_test.hpp>
#include <string>

#include "tumour_scenes.hpp"

using namespace cambium;
using namespace scenes;

namespace {

/// Names of the entries that are not the same to the last bit, NaN or not. Seconds are not asked for.
std::string differences(const Snapshot& a, const Snapshot& b) {
  std::string names = a.whole == b.whole && a.reals.size() == b.reals.size() ? "" : "whole numbers;";
  for (const auto& [name, values] : a.reals) {
    if (name.starts_with("seconds")) continue;
    const auto other = b.reals.find(name);
    const bool same = other != b.reals.end() && std::ranges::equal(values, other->second, [](double x, double y) {
                        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
                      });
    if (!same) names += ' ' + name;
  }
  return names;
}

/// The policies that have the most of what the next step starts from.
using Disc = Tumour<2, SemiImplicit, ZeroOutside, Necrosis, Diffusing>;

Disc grown(int steps) {
  Disc tumour(lattice<2>(36), ball<2>(1.8), {.parameters = {.necrotic_limit = 0.7, .tension = 0.5}}, {1});
  for (int i = 0; i < steps; ++i) tumour.step(0.02);
  return tumour;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_restored_tumour_goes_on_to_the_last_bit) {
  Disc whole = grown(3);
  const Snapshot middle = whole.save();
  Disc restored = Disc::restored(whole.lattice(), middle, whole.params(), {2});
  BOOST_TEST(differences(restored.save(), middle) == "");
  for (int i = 0; i < 4; ++i) {
    const double dt = whole.step(0.02).dt;
    BOOST_TEST(restored.step(0.02).dt == dt);
  }
  BOOST_TEST(differences(restored.save(), whole.save()) == "");
  BOOST_TEST(differences(whole.save(), middle) != "");
}

BOOST_AUTO_TEST_CASE(states_that_do_not_fit_are_refused) {
  const Disc disc = grown(1);
  const Snapshot good = disc.save();
  const auto restored = [&](const Snapshot& snapshot, std::ptrdiff_t cells = 36) {
    return Disc::restored(lattice<2>(cells), snapshot, disc.params(), {1});
  };
  BOOST_CHECK_THROW(restored(good, 40), SnapshotError);
  for (const auto& entry : good.reals) {
    Snapshot bad = good;
    bad.reals[entry.first].pop_back();
    BOOST_CHECK_THROW(restored(bad), SnapshotError);
    bad.reals.erase(entry.first);
    BOOST_CHECK_THROW(restored(bad), SnapshotError);
  }
  Snapshot bad = good;
  bad.whole["phi.blocks"][0] = 99;
  BOOST_CHECK_THROW(restored(bad), SnapshotError);
  bad.whole["phi.blocks"][0] = good.whole.at("phi.blocks")[2];
  bad.whole["phi.blocks"][1] = good.whole.at("phi.blocks")[3];
  BOOST_CHECK_THROW(restored(bad), SnapshotError);
}
