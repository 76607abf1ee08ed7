// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes.hpp"

#include <algorithm>
#include <utility>

#include <cambium/core/error.hpp>

namespace tumour {
namespace {

using cambium::TumourParameters;

/// Tensions here belong to the sum of the principal curvatures: in space, half of what belongs to their mean.
Options space(std::string shape, const TumourParameters& parameters, std::vector<double> at) {
  return {.dim = 3, .cells = 48, .box = 12.0, .shape = std::move(shape), .parameters = parameters, .at = std::move(at)};
}
TumourParameters growing(double tension) { return {.necrotic_limit = 0.0, .tension = tension}; }
TumourParameters relaxing(double tension) { return {.growth = 0.0, .necrotic_limit = 0.0, .tension = tension}; }

std::vector<Scene> make_scenes() {
  std::vector<Scene> list;
  const auto add = [&](const char* name, const char* what, Options options) {
    options.scene = name;
    options.out = std::string("out/tumour-") + name;
    list.push_back({name, what, std::move(options)});
  };
  const std::string ellipsoid = "ellipsoid:0.1,2";
  const std::string lump = "amorphous:1.3,2.4,7";
  add("sphere-relaxation", "surface tension alone: a sphere rests", space("ellipsoid:0,2", relaxing(0.5), {0.25, 0.5}));
  add("ellipsoid-relaxation", "surface tension alone: an ellipsoid becomes a sphere",
      space("ellipsoid:0.3,2", relaxing(0.5), {0.5, 1.0, 2.0, 4.0}));
  add("macklin-2d", "an ellipse in the plane grows fingers", {.parameters = growing(1.0), .at = {0.5, 1.0, 1.5, 2.0}});
  add("no-necrosis", "an ellipsoid grows", space(ellipsoid, growing(0.5), {0.5, 1.0, 1.5, 2.0}));
  auto wide = space(ellipsoid, growing(0.5), {1.0, 2.0});
  wide.box = 24.0;
  wide.cells = 96;
  add("domain-size", "the same in a box of twice the side, with the same spacing", wide);
  auto fine = space(ellipsoid, growing(0.5), {0.5, 1.0});
  fine.cells = 64;
  add("resolution", "the same on a finer lattice", fine);
  for (const auto& [name, limit] : {std::pair{"necrosis-0.25", 0.25}, {"necrosis-0.5", 0.5}, {"necrosis-0.75", 0.75}}) {
    add(name, "an ellipsoid with a core where the nutrient is too low",
        space(ellipsoid, TumourParameters::necrotic(limit, 0.5), {0.5, 1.0, 2.0}));
  }
  add("amorphous", "a lump grows", space(lump, growing(0.5), {0.5, 1.0, 1.5, 2.0}));
  add("amorphous-necrosis", "a lump with a necrotic core grows",
      space(lump, TumourParameters::necrotic(0.5, 0.5), {0.5, 1.0, 1.5, 2.0}));
  add("surface-tension-0", "an ellipsoid without surface tension: nothing damps the shortest waves",
      space(ellipsoid, growing(0.0), {0.5, 1.0, 1.5}));
  add("surface-tension-2", "with a tension of 2 for the mean of the curvatures, 1 for their sum",
      space(ellipsoid, growing(1.0), {0.5, 1.0, 1.5}));
  add("surface-tension-5", "with a tension of 5 for the mean of the curvatures, 2.5 for their sum",
      space(ellipsoid, growing(2.5), {0.5, 1.0, 1.5}));
  add("zero-outside", "two tumours and no pressure outside: interfaces join",
      {.shape = "pair:1.3,3.2", .parameters = growing(0.1), .outside = "zero", .at = {0.1, 0.15, 0.2, 0.25}});
  add("free-space-pair", "the same two with the pressure of free space: they keep apart",
      {.shape = "pair:1.3,3.2", .parameters = growing(0.1), .at = {0.25, 0.5, 0.75, 1.0}});
  add("extinction", "necrosis wins",
      {.shape = "ellipsoid:0,2",
       .parameters = {.apoptosis = 1.1, .necrotic_decay = 3.0, .necrotic_limit = 0.75, .tension = 0.1},
       .at = {0.1, 0.25, 4.0}});
  return list;
}

}  // namespace

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> list = make_scenes();
  return list;
}

Options scene_options(const std::string& name) {
  const auto found = std::ranges::find(scenes(), name, &Scene::name);
  if (found != scenes().end()) return found->options;
  std::string names;
  for (const Scene& scene : scenes()) names += ' ' + scene.name;
  throw cambium::ValueError("there is no scene '" + name + "'; there are:" + names);
}

}  // namespace tumour
