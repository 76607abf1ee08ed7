// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cambium/io/npy.hpp>

namespace tumour {
namespace {

using cambium::FileError;

/// What the first byte of an answer says.
constexpr char good = '+', refused = '-';

bool send(int pipe, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(pipe, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  return true;
}
std::string receive(int pipe) {
  std::string bytes;
  std::array<char, 1 << 16> piece;
  for (;;) {
    const ssize_t count = ::read(pipe, piece.data(), piece.size());
    if (count > 0) bytes.append(piece.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return bytes;
  }
}

/// Never returns: ends without what the program does at its end, which is the other process' to do.
[[noreturn]] void run_child(const std::string& input, unsigned seconds, const std::function<std::string()>& work,
                            int pipe) {
  const rlimit limit{seconds, seconds + 1}, no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &limit);
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) std::signal(signal, SIG_DFL);
  std::string answer;
  try {
    answer = good + work();
  } catch (const std::bad_alloc&) {
    answer = refused + input + ": what reads it asks for more memory than there can be in it: it is damaged";
  } catch (const std::exception& error) {
    answer = refused + std::string(error.what());
  }
  ::_exit(send(pipe, answer) ? 0 : 1);
}

}  // namespace

void allow_memory(double bytes) {
  double pages = 0.0;
  if (!(std::ifstream("/proc/self/statm") >> pages)) return;  // not Linux
  rlimit limit;
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = static_cast<rlim_t>(pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) + bytes);
  ::setrlimit(RLIMIT_AS, &limit);
}

std::string in_child_process(const std::string& input, unsigned seconds, const std::function<std::string()>& work) {
  const auto refuse = [&](const char* why) { throw FileError(input + why); };
  std::array<int, 2> pipe;
  if (::pipe(pipe.data()) != 0) refuse(" cannot be read: the system has no pipe left");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe[0]);
    run_child(input, seconds, work, pipe[1]);
  }
  ::close(pipe[1]);
  std::string answer = child > 0 ? receive(pipe[0]) : std::string();
  ::close(pipe[0]);
  if (child < 0) refuse(" cannot be read: the system starts no process for it");
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const bool ended = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !answer.empty();
  if (ended && answer[0] == good) return answer.substr(1);
  if (ended) throw FileError(answer.substr(1));
  const bool endless = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  refuse(endless ? ": reading it comes to no end: it is damaged" : ": what reads it crashed: it is damaged");
  return {};
}

}  // namespace tumour
