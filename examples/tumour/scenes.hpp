// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace tumour {

/// A run that has a name.
struct Scene {
  std::string name;
  std::string what;
  Options options;
};

const std::vector<Scene>& scenes();
/// \throws cambium::ValueError that names all scenes, if there is none of this name
Options scene_options(const std::string& name);

}  // namespace tumour
