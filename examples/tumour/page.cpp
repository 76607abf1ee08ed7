// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "page.hpp"

#include <sys/wait.h>
#include <unistd.h>

namespace tumour {
namespace {

/// Set by CMake: where the repository has the script.
constexpr const char* script = TUMOUR_PAGE_SCRIPT;
constexpr const char* interpreter = "/usr/bin/python3";

}  // namespace

std::string page_command(const std::string& folder) { return std::string(script) + " " + folder; }

bool draw_page(const std::string& folder) {
  const pid_t child = fork();
  if (child < 0) return false;
  if (child == 0) {
    execl(interpreter, interpreter, script, folder.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace tumour
