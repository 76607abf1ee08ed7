// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "checkpoint.hpp"
#include "options.hpp"
#include "stop_requests.hpp"

namespace tumour {

/// Grows a tumour as the options say and leaves files in their folder. Ends well with everything written when the last
/// time is reached, and before it when the tumour reaches the box, dies out, or a signal asks to stop; the report says
/// which. \param configuration  for the folder \param saved  what to go on from, or null \throws cambium::Error for
/// everything else, with what there is written
template <int D, class Outside>
nlohmann::json run(const Options& options, const std::string& configuration, const StopRequests& stop,
                   const Checkpoint* saved);

}  // namespace tumour
