// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace tumour {

/// The command that draws the pictures and the page of the run in a folder.
std::string page_command(const std::string& folder);
/// Runs it. False if it failed.
bool draw_page(const std::string& folder);

}  // namespace tumour
