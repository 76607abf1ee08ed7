// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "growing.hpp"

namespace tumour {

template nlohmann::json run<3, cambium::FreeSpace>(const Options&, const std::string&, const StopRequests&,
                                                   const Checkpoint*);

}  // namespace tumour
