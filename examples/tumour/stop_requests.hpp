// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <csignal>
#include <ctime>
#include <pthread.h>

namespace tumour {

/// SIGINT and SIGTERM are held back and asked for between steps. To be made before there are threads, which inherit it.
class StopRequests {
 public:
  StopRequests() {
    sigemptyset(&set_);
    sigaddset(&set_, SIGINT);
    sigaddset(&set_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &set_, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);  // files that may not grow are errors of writing, which say so
  }
  /// Whether one of the signals has come since this was last asked.
  bool arrived() const {
    const timespec at_once{};
    return sigtimedwait(&set_, nullptr, &at_once) > 0;
  }

 private:
  sigset_t set_;
};

}  // namespace tumour
