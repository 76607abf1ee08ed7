// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <cambium/core/error.hpp>

namespace tumour {

/// Reads numbers with commas between. \param what  option that the text is of, for the message
/// \throws cambium::ValueError if something is not a finite number
inline std::vector<double> numbers(const std::string& what, const std::string& text) {
  std::vector<double> values;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string word = text.substr(from, comma - from);
    char* end = nullptr;
    values.push_back(std::strtod(word.c_str(), &end));
    if (word.empty() || *end != '\0' || !std::isfinite(values.back())) {
      throw cambium::ValueError(what + ": '" + word + "' is not a number; numbers with commas between are needed");
    }
    from = comma + 1;
  }
  return values;
}

}  // namespace tumour
