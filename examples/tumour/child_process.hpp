// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace tumour {

/// The bytes that `work` returns, which is called in a process of its own: a library that crashes on input that is not
/// as it should be does not take the program with it. `work` must start no threads. \param input    what it reads, for
/// messages \param seconds  of the processor that it may take \throws cambium::FileError with the message of what
/// `work` throws; or that it crashed or took too long
std::string in_child_process(const std::string& input, unsigned seconds, const std::function<std::string()>& work);

/// From now on a child process may take so many bytes more than it has. What asks for more gets std::bad_alloc.
void allow_memory(double bytes);

}  // namespace tumour
